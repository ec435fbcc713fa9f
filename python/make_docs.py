"""Takes the comments (///) of C++ headers into one header that Python's docstrings refer to by name.

What `struct Frame { Points3 positions; ///< #V x 3 };` says of a member is wilt::docs::Frame::positions, what stands before
a function read_leaf is wilt::docs::read_leaf, before a type Frame wilt::docs::Frame::self. A name without a comment is not
there, so that what binds it does not compile. Of several declarations of a name the first that has a comment counts.
Errors are named as Python's.
Usage: make_docs.py OUTPUT HEADER...
"""
import pathlib
import re
import sys

ERRORS = {"configuration": "ValueError", "input": "ValueError", "output": "OSError", "simulation": "RuntimeError",
          "interrupted": "KeyboardInterrupt"}
TOKEN = re.compile(r'///<[^\n]*|///[^\n]*|//[^\n]*|#[^\n]*|"(?:\\.|[^"\\])*"|[{};]|[^/#"{};]+|.', re.S)
SCOPE = re.compile(r"^(?:inline\s+)?(?:struct|class|namespace)\b(?!.*[()=])\s*(?:\[\[\w+\]\]\s*)?([\w:]*)", re.S)


def names_of(statement):
    """What a declaration declares: a function, or one variable or more."""
    statement = re.sub(r"\b(public|private|protected)\s*:(?!:)", " ", statement)
    statement = re.sub(r"^\s*template\s*<[^;]*?>\s*(?=\w)", "", statement.strip())
    if not statement or re.match(r"(using|typedef|friend|static_assert|enum)\b", statement):
        return []
    call = re.search(r"([A-Za-z_]\w*)\s*\(", re.sub(r"<[^()]*?>", "", statement))
    before_call = statement.split("(")[0]
    if call and "=" not in before_call:
        return [call.group(1)]
    bare = re.sub(r"\{[^{}]*\}", "", statement)
    while re.search(r"<[^<>]*>", bare):
        bare = re.sub(r"<[^<>]*>", "", bare)
    return [m.group(1) for part in bare.split(",") if (m := re.search(r"([A-Za-z_]\w*)\s*(?:=.*)?$", part.strip(), re.S))]


class Reader:
    """Reads one header; `docs` is {(scope, ...): {name: text}}."""

    def __init__(self, docs):
        self.docs = docs
        self.scopes, self.pending, self.statement, self.last = [], [], "", []
        self.skipped = 0  # depth inside a body or an initialiser

    def put(self, names, lines):
        place = self.docs.setdefault(tuple(s for s in self.scopes if s), {})
        for name in names:
            if lines and name not in place:
                place[name] = list(lines)

    def end(self):
        self.last = names_of(self.statement)
        self.put(self.last, self.pending)
        self.statement, self.pending = "", []

    def open_brace(self):
        scope = SCOPE.match(self.statement.strip())
        if self.skipped or not scope:
            self.skipped += 1
            self.statement += "{"
            return
        name = "" if "namespace" in self.statement else scope.group(1)
        self.scopes.append(name)
        if name:
            self.put(["self"], self.pending)
        self.statement, self.pending = "", []

    def close_brace(self):
        if not self.skipped:
            self.scopes.pop()
            return
        self.skipped -= 1
        self.statement += "}"
        if not self.skipped and "(" in self.statement.split("{")[0]:
            self.end()  # a function's body

    def trailing(self, text):
        names = names_of(self.statement) if self.statement.strip() else self.last
        place = self.docs.setdefault(tuple(s for s in self.scopes if s), {})
        for name in names:
            place.setdefault(name, []).append(text)

    def read(self, text):
        for token in TOKEN.findall(text):
            if token.startswith("///<"):
                if not self.skipped:
                    self.trailing(token[4:].strip())
            elif token.startswith("///"):
                if not self.skipped:
                    self.pending.append(token[3:].removeprefix(" ").rstrip())
            elif token.startswith(("//", "#")):
                continue
            elif token == "{":
                self.open_brace()
            elif token == "}":
                self.close_brace()
            elif token == ";" and not self.skipped:
                self.end()
            else:
                self.statement += token if not self.skipped or token == "}" else ""


def in_python(lines):
    text = "\n".join(lines).strip()
    text = re.sub(r"\s\(\w+\.hpp\)", "", text.replace("::", ".")).replace(" thrown", " raised")
    text = re.sub(r"Error\{(\w+)\}", lambda m: ERRORS[m.group(1)], text)
    return re.sub(r"\b(T|t)hrows\b", lambda m: "Raises" if m.group(1) == "T" else "raises", text)


def header_of(docs):
    lines = ["// Made by make_docs.py of the comments of headers; not to be edited.", "#pragma once", ""]
    for scope, names in sorted(docs.items()):
        if not names:
            continue
        lines.append("namespace " + "::".join(("wilt", "docs") + scope) + " {")
        for name, text in sorted(names.items()):
            lines.append(f'inline constexpr const char* {name} = R"doc({in_python(text)})doc";')
        lines.append("}")
    return "\n".join(lines) + "\n"


def main():
    output, *headers = sys.argv[1:]
    docs = {}
    for header in headers:
        Reader(docs).read(pathlib.Path(header).read_text())
    pathlib.Path(output).write_text(header_of(docs))


if __name__ == "__main__":
    main()
