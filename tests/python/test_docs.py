"""Everything public has words and a place in the stubs.

Oracle: what dir() lists of the module, against the parsed stubs.
"""
import ast
import inspect
import pathlib
import unittest

import wilt

CLASSES = [member for _, member in inspect.getmembers(wilt, inspect.isclass)]


def public(names):
    return {name for name in names if not name.startswith("_")}


class Stubs(unittest.TestCase):
    def setUp(self):
        path = pathlib.Path(wilt._core.__file__).parent / "_core.pyi"
        self.tree = ast.parse(path.read_text())
        self.classes = {node.name: node for node in self.tree.body if isinstance(node, ast.ClassDef)}

    def members(self, cls):
        own = {node.name for node in self.classes[cls.__name__].body if isinstance(node, ast.FunctionDef)}
        return own.union(*(self.members(base) for base in cls.__bases__ if base.__name__ in self.classes))

    def test_name_every_public_attribute(self):
        self.assertEqual(public(wilt.__all__), public(vars(wilt._core)))
        functions = {node.name for node in self.tree.body if isinstance(node, ast.FunctionDef)}
        self.assertEqual(functions | set(self.classes), public(vars(wilt._core)))
        for cls in CLASSES:
            self.assertEqual(public(self.members(cls)), public(dir(cls)), cls)

    def test_say_what_comes_back(self):
        for node in ast.walk(self.tree):
            if isinstance(node, ast.FunctionDef):
                self.assertIsNotNone(node.returns, node.name)
                if node.name not in ("__next__",):
                    self.assertNotIn("_core", ast.unparse(node), node.name)

    def test_are_marked_as_the_packages_types(self):
        self.assertTrue((pathlib.Path(wilt.__file__).parent / "py.typed").exists())


class Words(unittest.TestCase):
    def test_stand_with_everything_public(self):
        for cls in CLASSES:
            self.assertTrue(inspect.getdoc(cls), cls)
            for name in public(dir(cls)):
                text = inspect.getdoc(getattr(cls, name)) or ""
                words = [line for line in text.splitlines() if line and not line.startswith(name + "(")]
                self.assertTrue(words, f"{cls.__name__}.{name}")
                self.assertNotIn("Error{", text)

    def test_give_shapes_and_units_of_arrays(self):
        for name in ("positions", "faces", "uv", "stalk"):
            self.assertRegex(inspect.getdoc(getattr(wilt.Leaf, name)), r"#\w( x \d)?", name)
        for name in ("velocities", "water", "pressure"):
            self.assertRegex(inspect.getdoc(getattr(wilt.State, name)), r"#V.*working", name)


if __name__ == "__main__":
    unittest.main()
