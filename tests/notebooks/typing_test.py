"""The types of the package soilbin: the stub names what the extension holds, the package keeps to it, misuse is found."""
import importlib
import inspect
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

PACKAGE = Path(sys.argv.pop(1))  # as the build made it

RIGHT = """
import soilbin
from soilbin import bekker_wong, compare

wheel = soilbin.Scenario("rover-wheel", "dry-sand", effects=["slip_sinkage"])
pull: float = soilbin.estimate(wheel, load=80.0, slip=0.2).drawbar_pull.value
wider: soilbin.Tire = wheel.tire.replace(width=0.2)
sand = soilbin.find_soil("dry-sand").semi_empirical
if sand is not None:
    sand.replace(k_phi=8e6, cohesion=soilbin.Estimate(500.0, 100.0))
answer: compare.LoopAnswer = compare.run_loop("made-lesson", progress=lambda share, stage: print(share, stage))
"""

WRONG = {
    'import soilbin\nsoilbin.Tire(raduis=0.1, width=0.1)': "raduis",
    'import soilbin\nsoilbin.Tire(radius="11 mm", width=0.1)': "str",
    'import soilbin\nsoilbin.find_tire("rover-wheel").raduis': "raduis",
    'import soilbin\nsoilbin.find_soil("dry-sand").semi_empirical.k_phi': "None",
    'import soilbin\nx: float = soilbin.find_case("rover-slip").study': "Study",
}


def mypy(*arguments):
    command = ["/usr/bin/mypy", "--strict", "--ignore-missing-imports", "--cache-dir", CACHE.name, *arguments]
    done = subprocess.run(command, capture_output=True, text=True, cwd=CACHE.name,
                          env={"MYPYPATH": str(PACKAGE.parent), "PATH": "/usr/bin:/bin", "LC_ALL": "C.UTF-8"})
    return done.returncode, done.stdout + done.stderr


class Typing(unittest.TestCase):
    def test_the_stub_names_all_that_the_extension_holds(self):
        extension = importlib.import_module("soilbin._soilbin")
        self.assertEqual(Path(extension.__file__).parent, PACKAGE)
        held = {name for name, value in vars(extension).items()
                if inspect.isclass(value) or (inspect.isroutine(value) and not name.startswith("__"))}
        stub = (PACKAGE / "_soilbin.pyi").read_text(encoding="utf-8")
        self.assertEqual(set(re.findall(r"^(?:class|def) (\w+)", stub, flags=re.M)), held)
        self.assertIn('    @property\n    def radius(self) -> float:\n        """', stub)  # what a member means, and its unit

    def test_the_package_keeps_to_its_types(self):
        status, said = mypy(str(PACKAGE))
        self.assertEqual(status, 0, said)

    def test_right_use_passes(self):
        status, said = mypy("-c", RIGHT)
        self.assertEqual(status, 0, said)

    def test_misuse_is_found(self):
        for program, expected in WRONG.items():
            status, said = mypy("-c", program)
            self.assertEqual(status, 1, program)
            self.assertIn(expected, said)


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as folder:
        CACHE = type("Cache", (), {"name": folder})
        unittest.main(verbosity=2)
