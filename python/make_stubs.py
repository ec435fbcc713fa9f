"""Writes the type stubs of the extension wilt._core from the signatures and docstrings that pybind11 gives it.

Usage: make_stubs.py PYTHONPATH OUTPUT
"""
import importlib
import inspect
import pathlib
import re
import sys

HEAD = """# Made by make_stubs.py of the built module; not to be edited.
import os
from typing import Any, Callable, Iterator, Optional, Tuple, Union

import numpy
import numpy.typing
"""
TYPES = [(r"wilt\._core\.", ""), (r"numpy\.ndarray\[numpy\.(\w+)\]", r"numpy.typing.NDArray[numpy.\1]"),
         (r"os\.PathLike", "Union[str, os.PathLike[str]]"), (r"\bDict\b", "dict"), (r"\bList\b", "list"),
         (r"(?<![\w.])handle\b", "Any"), (r"(?<![\w.])function\b", "Callable[..., Any]"), (r"(?<![\w.])object\b", "Any"),
         (r"Annotated\[list\[float\], FixedSize\(2\)\]|list\[float\[2\]\]", "Tuple[float, float]"),
         (r"\*args(?=[,)])", "*args: Any"), (r"\*\*kwargs(?=[,)])", "**kwargs: Any")]


def typed(signature):
    for pattern, replacement in TYPES:
        signature = re.sub(pattern, replacement, signature)
    return signature


def split_doc(name, doc):
    """The signature after the function's name, and the words below it."""
    first, _, rest = (doc or "").partition("\n")
    match = re.match(rf"(?:{re.escape(name)})?(\(.*)$", first)
    if not match:
        raise SystemExit(f"make_stubs: '{name}' has no signature in its docstring: {doc!r}")
    return typed(match.group(1)), rest.strip()


def docstring(words, indent):
    if not words:
        return []
    lines = words.replace("\\", "\\\\").replace('"""', "'''").splitlines()
    lines = [f'{indent}"""{lines[0]}', *(indent + line if line else "" for line in lines[1:])]
    lines[-1] += ('" ' if lines[-1].endswith('"') else "") and ""
    return lines[:-1] + [lines[-1] + (' """' if lines[-1].endswith('"') else '"""')]


def function(name, doc, indent, decorator=None):
    signature, words = split_doc(name, doc)
    lines = [indent + decorator] if decorator else []
    body = docstring(words, indent + "    ")
    return lines + [f"{indent}def {name}{signature}:" + ("" if body else " ...")] + body


def prop(name, member, indent):
    signature, _ = split_doc("", member.fget.__doc__ or "")
    returned = signature.rpartition("->")[2].strip()
    words = inspect.getdoc(member) or ""
    return [f"{indent}@property", f"{indent}def {name}(self) -> {returned}:"] + (docstring(words, indent + "    ") or
                                                                              [indent + "    ..."])


def class_stub(cls):
    bases = [base.__name__ for base in cls.__bases__ if base.__module__ == cls.__module__]
    lines = ["", "", f"class {cls.__name__}{'(' + bases[0] + ')' if bases else ''}:"]
    lines += docstring(inspect.cleandoc(cls.__doc__ or ""), "    ")
    for name, member in vars(cls).items():
        if name.startswith("_") and name not in ("__init__", "__iter__", "__next__", "__enter__", "__exit__"):
            continue
        if name == "__init__" and "instance" in type(member).__name__ and not (member.__doc__ or "").startswith("__init__("):
            continue
        if name == "__init__" and not (member.__doc__ or "").startswith("__init__("):
            continue  # made by functions only
        lines.append("")
        if isinstance(member, property):
            lines += prop(name, member, "    ")
        elif isinstance(member, staticmethod):
            lines += function(name, member.__func__.__doc__, "    ", "@staticmethod")
        else:
            lines += function(name, member.__doc__, "    ")
    return lines


def main():
    path, output = sys.argv[1:]
    sys.path.insert(0, path)
    sys.dont_write_bytecode = True
    core = importlib.import_module("wilt._core")
    lines = [HEAD + "\n__version__: str"]
    for name, member in vars(core).items():
        if inspect.isclass(member):
            lines += class_stub(member)
        elif callable(member):
            lines += ["", ""] + function(name, member.__doc__, "")
    pathlib.Path(output).write_text("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
