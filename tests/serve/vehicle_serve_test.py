"""`soilbin serve VEHICLE`: what it answers over HTTP.

Usage: vehicle_serve_test.py SOILBIN
"""
import json
import os
import shlex
import socket
import tempfile
import time
import unittest
from pathlib import Path

from server import Server, soilbin

CRAWLER = """format: soilbin-vehicle-case/1
name: crawler
mass: 400 kg
centre_of_gravity: {x: 1 m, z: 0.5 m}
drive_line: motors
axles:
  - {name: front, x: 2 m, track: 1.2 m, largest_torque: 300 N m, tire: rover-wheel}
  - {name: middle, x: 1 m, track: 1.2 m, driven: no, tire: rover-wheel}
  - {name: rear, x: 0 m, track: 1.2 m, largest_torque: 300 N m, tire: rover-wheel}
soil: sandy-loam
drive:
  duration: 2 s
  profile:
    - {at: 1 m}
    - {at: 4 m, longitudinal_incline: 5 deg}
"""


def train(axles):
    """A vehicle of so many axles, alike and 2 m apart."""
    rows = "\n".join(f"  - {{name: axle {i}, x: {2 * (axles - i)} m, track: 2 m, tire: 14.00R20}}" for i in range(axles))
    return (f"format: soilbin-vehicle-case/1\nname: train\nmass: {5 * axles} t\n"
            f"centre_of_gravity: {{x: {axles + 1} m, z: 1.2 m}}\naxles:\n{rows}\nsoil: sandy-loam\n")


class AVehicle(unittest.TestCase):
    """A truck, and a rover, whose whole answers are quicker."""
    @classmethod
    def setUpClass(cls):
        cls.server, cls.rover = Server("truck", "--slope", "2deg"), Server("rover", "--soil", "sandy-loam")

    @classmethod
    def tearDownClass(cls):
        cls.server.stop()
        cls.rover.stop()

    def refused(self, words, path="/vehicle", **flags):
        status, document = self.server.answer(path, **flags)
        self.assertEqual(status, 400, document)
        self.assertIn(words, f"{document['error']}\n{document['hint']}")

    def told(self, served):
        """What its own command answers at a terminal."""
        words = shlex.split(served["command"])
        self.assertEqual(words[:2], ["soilbin", "vehicle"])
        return json.loads(soilbin(*words[1:], "--json").stdout)

    def assert_as_told(self, served):
        told = self.told(served)
        self.assertEqual({key: served[key] for key in told}, told)

    def test_says_what_the_command_says_that_it_shows(self):
        for flags in ({}, {"slope": "-8deg", "pull": "4N", "speed": "0.2 m/s"}, {"cross_slope": "7.5deg"},
                      {"mass": "63kg", "centre-of-gravity-x": "0.5m", "centre-of-gravity-z": "1 m", "power": "150W"},
                      {"drive-line": "sides"},
                      {"soil": "dry-sand", "friction-angle": "33+-2deg", "k-phi": "1200+-100kN/m^(n+2)"},
                      {"effect": "none"}, {"effect": ["multipass", "slip_sinkage:lyasko,a=0.5"], "rigid": "true"}):
            status, served = self.rover.answer("/vehicle", **flags)
            self.assertEqual(status, 200, served)
            self.assertEqual(served["format"], "soilbin-vehicle-answer/1")
            self.assert_as_told(served)
        self.assert_as_told(self.server.answer("/vehicle", slope="5deg")[1])

    def test_the_drive_is_that_of_the_command(self):
        status, served = self.rover.answer("/drive", slope="5deg")
        self.assertEqual((status, served["format"]), (200, "soilbin-vehicle-drive/1"))
        self.assertTrue(served["command"].endswith("--drive"))
        self.assert_as_told(served)
        self.assertEqual([a["name"] for a in served["places"]["axles"]], [a["axle"] for a in served["axles"]])

    def test_a_drive_that_can_not_be_asked_says_why(self):
        self.refused("cross slope", "/drive", cross_slope="5deg")
        status, served = self.server.answer("/drive", slope="44deg")
        self.assertEqual((status, served["end"], served["curves"]), (200, None, None))
        self.assertIn("does not stand at its start", served["no_answer"])

    def test_the_drawing_has_each_wheel_as_the_answer_has_it(self):
        _, served = self.rover.answer("/vehicle", cross_slope="5deg")
        drawn, told = served["state"]["wheels"], served["steady"]["wheels"]
        for a, b in zip(drawn, told, strict=True):
            self.assertEqual((a["name"], a["load"], a["slip"], a["sinkage"]),
                             (b["wheel"], b["normal_load"]["value"], b["slip"]["value"], b["sinkage"]["value"]))
        self.assertEqual([served["places"]["axles"][a["axle"]]["name"] for a in drawn], ["front", "front", "rear", "rear"])

    def test_a_vehicle_that_does_not_travel_is_an_answer(self):
        status, served = self.rover.answer("/vehicle", slope="40deg")
        self.assertEqual((status, served["steady"], served["state"]["goes"]), (200, None, False))
        self.assertIn("does not travel", served["no_answer"])
        self.assertEqual(served["key_figures"][0]["value"], "It does not travel")
        self.assertGreater(served["steepest"]["up"]["slope"]["value"], 0.1)
        self.assert_as_told(served)

    def test_the_point_lies_on_the_curve_of_the_pull(self):
        _, served = self.server.answer("/state", pull="6kN")
        point = served["curves"]["plots"][0]["series"][-1]
        self.assertEqual(point["label"], "this point")
        self.assertAlmostEqual(point["y"][0], 6, 4)  # kN, as the slider
        self.assertAlmostEqual(point["x"][0], 100 * served["state"]["wheels"][0]["slip"], 3)  # locked: all slip alike

    def test_the_file_that_is_saved_is_the_question(self):
        flags = {"mass": "60kg", "drive-line": "sides", "soil": "dry-sand", "friction-angle": "31+-2deg", "pull": "3N"}
        _, served = self.rover.answer("/vehicle", **flags)
        query = "&".join(f"{key}={value}".replace("+", "%2B") for key, value in flags.items())
        with tempfile.TemporaryDirectory() as folder:
            saved = Path(folder) / "vehicle.yaml"
            saved.write_text(self.rover.ask(f"/vehicle.yaml?{query}")[2])
            told = json.loads(soilbin("vehicle", str(saved), "--json").stdout)
            self.assertEqual({key: served[key] for key in told if key != "warnings"},
                             {key: told[key] for key in told if key != "warnings"})
            self.assertEqual(soilbin("check", str(saved)).returncode, 0)
            curves = Path(folder) / "pulls.csv"
            soilbin("vehicle", str(saved), "--csv", str(curves))
            self.assertEqual(self.rover.ask(f"/pulls.csv?{query}")[2], curves.read_text())
        self.assertIn("slip;pull_N", self.rover.ask(f"/pulls.csv?decimal-comma=true&{query}")[2][:40])

    def test_numbers_stand_where_the_query_puts_them(self):
        start = json.loads(self.server.ask("/case")[2])
        self.assertEqual({n["key"]: (n["value"], n["unit"]) for n in start["numbers"] if n["group"] != "soil"},
                         {"slope": (2, "deg"), "cross-slope": (0, "deg"), "speed": (2, "m/s"), "pull": (0, "kN"),
                          "mass": (11000, "kg"), "power": (200, "kW"), "centre-of-gravity-x": (2.4, "m"),
                          "centre-of-gravity-z": (1.4, "m")})
        for n in start["numbers"]:
            self.assertLess(n["lower"], n["upper"], n)
            self.assertGreater(n["step"], 0, n)
            self.assertTrue(n["lower"] <= n["value"] <= n["upper"], n)
        self.assertEqual(start["axles"], [{"name": "front", "driven": True}, {"name": "rear", "driven": True}])
        line, centre = start["choices"]
        self.assertEqual(line["words"], ["locked", "open_axles", "sides", "motors"])
        for word in line["words"]:  # the page offers a centre differential where the server takes it
            status, _ = self.server.answer("/state", **{"drive-line": word, "centre-differential": "locked"})
            self.assertEqual(status == 200, word in centre["drive_lines"], word)
        self.assertEqual([e["on"] for e in start["effects"] if e["on"]], ["multipass:stiffer"])
        _, served = self.server.answer("/state", mass="9t", pull="-2500 N", friction_angle="30+-1deg")
        numbers = {n["key"]: n for n in served["numbers"]}
        self.assertEqual((numbers["mass"]["value"], numbers["pull"]["value"]), (9000, -2.5))
        self.assertLessEqual(numbers["pull"]["lower"], -2.5)
        self.assertEqual((numbers["friction-angle"]["value"], numbers["friction-angle"]["sd"]), (30, 1))

    def test_refuses_with_a_hint_as_the_command_does(self):
        self.refused("did you mean '--slope'?", slpoe="5deg")
        self.refused("no axle is called 'reer', did you mean 'rear'?", driven="reer")
        self.refused("is none of the library's soils", soil="/etc/passwd")
        self.refused("'vehicle' has no option '--slip'", slip="20%")
        self.refused("a length", mass="3m")
        self.refused("--effect: unknown effect", effect="mutlipass")
        self.assertEqual(self.server.ask("/estimate?slip=20%25")[0], 404)
        self.assertEqual(self.server.ask("/vehicle?slope")[0], 400)

    def test_the_state_is_that_of_the_whole_answer(self):
        for flags in ({}, {"slope": "40deg"}, {"power": "1W"}, {"cross_slope": "5deg", "pull": "3N"}):
            status, whole = self.rover.answer("/vehicle", **flags)
            quick = self.rover.answer("/state", **flags)[1]
            self.assertEqual((status, whole["in_full"], quick["in_full"]), (200, True, False))
            for key in ("state", "places", "command", "in_words", "numbers", "effects", "no_answer"):
                self.assertEqual(quick[key], whole[key], key)
            self.assertEqual(quick["sentences"][0]["about"], whole["sentences"][0]["about"])
            pulls = [document["curves"]["plots"][0]["series"][0]["y"] for document in (quick, whole)]
            self.assertEqual(*pulls)

    def test_an_answer_that_nobody_waits_for_is_given_up(self):
        with Server("tractor") as server:
            with socket.create_connection(("127.0.0.1", server.port)) as line:
                line.sendall(b"GET /vehicle HTTP/1.1\r\nHost: localhost\r\n\r\n")
                time.sleep(0.3)
            started = processor_seconds(server.process.pid)
            self.assertEqual(server.ask("/case")[0], 200)
            self.assertLess(processor_seconds(server.process.pid) - started, 0.3)

    def test_is_quick(self):
        for name, path, times in (("truck", "/state", 20), ("tractor", "/state", 20), ("rover", "/state", 20), ("rover", "/vehicle", 1)):
            with Server(name) as server:
                started = processor_seconds(server.process.pid)
                for i in range(times):
                    self.assertEqual(server.answer(path, slope=f"{i / 4}deg")[0], 200)
                spent = (processor_seconds(server.process.pid) - started) / times
                print(f"{name}: {path} in {1000 * spent:.0f} ms of the processor")
                self.assertLess(spent, 0.1 if path == "/state" else 5.0)


def processor_seconds(process):
    """User and system time of a process so far."""
    fields = Path(f"/proc/{process}/stat").read_text().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


class Starts(unittest.TestCase):
    def test_from_a_file_of_ones_own(self):
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "my crawler.yaml"
            file.write_text(CRAWLER)
            with Server(str(file)) as server:
                start = json.loads(server.ask("/case")[2])
                self.assertEqual([axle["driven"] for axle in start["axles"]], [True, False, True])
                self.assertEqual({n["key"]: n["value"] for n in start["numbers"] if n["key"] == "power"}, {"power": None})
                status, served = server.answer("/state", driven="front")
                self.assertEqual(status, 200, served)
                self.assertEqual([axle["driven"] for axle in served["places"]["axles"]], [True, False, False])
                status, refused = server.answer("/drive", slope="3deg")
                self.assertEqual(status, 400)
                self.assertIn("--slope has no effect: the file's drive has a profile of its own", refused["error"])
                status, refused = server.answer("/vehicle", **{"drive-line": "locked"})
                self.assertEqual(status, 400)
                self.assertIn("which belongs to the drive_line 'motors'", refused["error"])

    def test_an_axle_that_is_not_driven_is_one_whose_file_says_so(self):
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "towed.yaml"
            file.write_text(CRAWLER.replace("driven: no, ", ""))
            with Server(str(file), "--driven", "front,rear") as by_flag:
                asked = by_flag.answer("/state", slope="2deg")[1]
            file.write_text(CRAWLER)
            with Server(str(file)) as by_file:
                said = by_file.answer("/state", slope="2deg")[1]
            for key in ("state", "places", "curves"):
                self.assertEqual({**asked, "curves": asked["curves"]["plots"]}[key], {**said, "curves": said["curves"]["plots"]}[key])

    def test_from_flags_of_the_vehicle(self):
        with Server("tractor", "--driven", "rear", "--soil", "dry-sand", "--cohesion", "2kPa") as server:
            start = json.loads(server.ask("/case")[2])
            self.assertEqual([axle["driven"] for axle in start["axles"]], [False, True])
            self.assertIn("--cohesion=2kPa", server.answer("/state")[1]["command"])
            self.assertNotIn("--cohesion", server.answer("/state", soil="sandy-loam")[1]["command"])

    def test_flags_of_the_other_page_are_refused(self):
        for words, said in ((("truck", "--slip", "20%"), "'vehicle' has no option '--slip'"),
                            (("paper-straight", "--mass", "3t"), "'estimate' has no option '--mass'"),
                            (("trukc",), "did you mean the vehicle 'truck'?")):
            run = soilbin("serve", "--port", "0", *words)
            self.assertEqual(run.returncode, 2, words)
            self.assertIn(said, run.stderr)

    def test_of_many_axles(self):
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "train.yaml"
            file.write_text(train(12))
            with Server(str(file)) as server:
                started = processor_seconds(server.process.pid)
                status, served = server.answer("/state")
                self.assertEqual((status, len(served["state"]["wheels"])), (200, 24))
                print(f"12 axles: /state in {1000 * (processor_seconds(server.process.pid) - started):.0f} ms of the processor")


if __name__ == "__main__":
    unittest.main(verbosity=2)
