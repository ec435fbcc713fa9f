"""The measured parts of docs/performance.md: each stands between <!-- begin: NAME --> and <!-- end: NAME -->."""
import os
import pathlib
import platform
import re
import subprocess


def replace(path, blocks):
    """Puts each block's lines between its markers. Raises ValueError for one that the page does not have."""
    text = pathlib.Path(path).read_text()
    for name, lines in blocks.items():
        pattern = re.compile(rf"(<!-- begin: {name} -->\n).*?(<!-- end: {name} -->)", re.DOTALL)
        if not pattern.search(text):
            raise ValueError(f"{path} has no block '{name}'")
        content = "\n".join(lines) + "\n"
        text = pattern.sub(lambda match, content=content: match[1] + content + match[2], text)
    pathlib.Path(path).write_text(text)


def lscpu():
    fields = {}
    for line in subprocess.run(["lscpu"], capture_output=True, text=True, env={**os.environ, "LC_ALL": "C"}).stdout.splitlines():
        key, _, value = line.partition(":")
        fields[key.strip()] = value.strip()
    return fields


def machine_lines(build, quiet):
    """Class of processor, caches, compiler, flags, how quiet it was by row; no names of hosts."""
    cpu = lscpu()
    cache = (pathlib.Path(build) / "CMakeCache.txt").read_text()
    flags = re.search(r"CMAKE_CXX_FLAGS_RELEASE:\w+=(.*)", cache)[1]
    compiler = subprocess.run(["c++", "--version"], capture_output=True, text=True).stdout.splitlines()[0]
    vectors = next((name for name, flag in (("AVX-512", "avx512f"), ("AVX2", "avx2")) if flag in cpu.get("Flags", "")), "no AVX2")
    memory = os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE")
    virtual = ", virtual" if cpu.get("Hypervisor vendor") else ""
    yield f"- Processor: {cpu.get('Model name')} (family {cpu.get('CPU family')}, model {cpu.get('Model')}), " \
          f"{os.cpu_count()} processors{virtual}, {vectors}; {1e-9 * memory:.0f} GB of memory."
    yield "- Caches: " + "; ".join(f"{key[:-6]} {value}" for key, value in cpu.items() if key.endswith("cache")) + "."
    yield f"- {compiler}, `{flags}`, no -march flags; Linux {platform.release().split('-')[0]}."
    yield f"- Of the processors' time {min(quiet):.0%} to {max(quiet):.0%} was free while rows were measured; with less than 90 % " \
          "a row says so and does not count."
