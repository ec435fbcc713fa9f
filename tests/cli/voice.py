"""How wilt's messages read: what, where, what is allowed, how to fix it, in one voice."""
import re

# Traces of the inside of the program, and of libraries that speak in another voice.
FOREIGN = re.compile(r"std::|::\w|what\(\)|exception|terminate|\b0x[0-9a-f]{4}|\(null\)|basic_string|Assertion|json\.|"
                     r"not in range|Could not convert|was not expected|required but received|REQUIRED|\bINT\b|\bTEXT\b")
# Words of a remedy, or a statement of what is allowed.
REMEDY = re.compile(r"did you mean|see `wilt|between|allowed|takes |takes$|give |choose|add |make it|install|free |remove|check |"
                    r"try |delete|put quotes|lists them all|results are|must be|is \.|there are|species are|available|known|are lines|are \.|a film \.|cut it|send it|goes with|"
                    r"go with|has ended|to \d|one of|raise|open it|draw |scale|simplify|clean|leaves? out|needs? |--resume|"
                    r"was written|not written|are done|at most|shows \d|nothing more|lost|has the frames|neither|name the|edit|fit |export|write it")


def faults(stderr):
    """What is wrong with the error and warning messages in stderr; none: an empty list."""
    found = []
    for line in stderr.splitlines():
        kind = re.match(r"(error|warning): (.*)", line)
        if not kind:
            continue
        text = kind.group(2)
        if text.endswith((".", "!", "; ", ": ")) and not text.endswith("..."):
            found.append(f"ends with a stop: {line}")
        if "'" not in text and FOREIGN.search(text) or FOREIGN.search(re.sub(r"'[^']*'", "''", text)):
            found.append(f"speaks of the program's inside: {line}")
        if text[:1].isupper() and not re.match(r"[A-Z]{2,}", text):
            found.append(f"begins with a capital: {line}")
        if kind.group(1) == "error" and not REMEDY.search(text):
            found.append(f"names no remedy: {line}")
    if re.search(r"terminate called|Segmentation|core dumped|Traceback", stderr):
        found.append(f"a crash: {stderr}")
    return found
