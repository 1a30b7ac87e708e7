"""The package soilbin: the same answers as the command's, errors with places, arrays without copies, work that stops."""
import contextlib
import io
import json
import math
import os
import pickle
import re
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest
import warnings
import zipfile
from pathlib import Path

COMMAND = sys.argv.pop(1)

import numpy as np  # noqa: E402

import soilbin  # noqa: E402
from soilbin import bekker_wong, compare, dem, lessons  # noqa: E402

ROVER = soilbin.Scenario("rover-wheel", "dry-sand")
AT = soilbin.OperatingCondition(load=64.68, slip=0.2)


def command(*words):
    done = subprocess.run([COMMAND, *words, "--json"], capture_output=True, text=True, check=True)
    return json.loads(done.stdout)


class Answers(unittest.TestCase):
    def test_estimate_says_what_the_command_says(self):
        row = command("estimate", "--tire", "rover-wheel", "--soil", "dry-sand", "--load", "64.68N", "--slip", "20%")["rows"][0]
        here = soilbin.estimate(ROVER, AT)
        self.assertEqual(here.drawbar_pull.value, row["drawbar_pull"])
        self.assertEqual(here.sinkage.std_error, row["std_error"]["sinkage"])
        self.assertAlmostEqual(sum(here.budget.values()), here.drawbar_pull.value, delta=1e-9)

    def test_an_explanation_prints_its_steps(self):
        why = bekker_wong.explain(ROVER, AT)
        self.assertIn("Equations with their values\n", str(why))
        for step in why.steps:
            self.assertIn(f"  {step.name}\n      {step.equation}\n", str(why))
            self.assertIn(step.name, repr(why))
        self.assertNotIn("object at 0x", repr(why))

    def test_a_study_gives_a_frame_of_the_commands_rows(self):
        rows = command("run", "rover-slip")["rows"]
        frame = soilbin.run_study("rover-slip")
        self.assertEqual(len(frame), len(rows))
        for name in ("slip", "drawbar_pull", "torque", "sinkage"):
            self.assertTrue(np.array_equal(frame[name], [row[name] for row in rows]), name)
        self.assertEqual(list(frame.model.unique()), ["bekker_wong", "bekker_wong + slip_sinkage"])

    def test_resistive_force_theory_is_a_model_too(self):
        values = soilbin.ResistiveForceSoil(xi_n=soilbin.Estimate(1e6, 1e5), surface_friction=0.5)
        scenario = soilbin.Scenario("rover-wheel", soilbin.find_soil("dry-sand").replace(resistive_force=values))
        frame = soilbin.sweep(scenario, soilbin.conditions(load=60.0, slip=[0.1, 0.3]), soilbin.ResistiveForce())
        self.assertTrue((frame.error == "").all())
        self.assertTrue((frame.drawbar_pull_std_error > 0).all())
        self.assertEqual(list(frame.filter(like="budget_")), ["budget_tread", "budget_sides"])
        self.assertGreater(frame.sinkage[1], frame.sinkage[0])

    def test_the_cone_index_is_a_model_too_and_tells_no_sinkage(self):
        soil = soilbin.Soil(name="loam", cone_index=soilbin.Estimate(3e5, 3e4))
        tire = soilbin.Tire(name="tire", radius=0.352, width=0.226, section_height=0.15, inflation_pressure=1.5e5)
        frame = soilbin.sweep(soilbin.Scenario(tire, soil), soilbin.conditions(load=4e3, slip=[0.1, 0.3]), soilbin.ConeIndex())
        self.assertTrue((frame.error == "").all())
        self.assertTrue((frame.drawbar_pull_std_error > 0).all())
        self.assertTrue(frame.sinkage.isna().all())
        self.assertEqual(list(frame.filter(like="budget_")), ["budget_gross_traction", "budget_motion_resistance"])

    def test_a_condition_without_solution_is_a_row_with_its_error(self):
        frame = soilbin.sweep(ROVER, soilbin.conditions(load=[60.0, 1e5], slip=0.2))
        self.assertEqual(frame.error[0], "")
        self.assertIn("sink deeper", frame.error[1])
        self.assertTrue(math.isnan(frame.drawbar_pull[1]))

    def test_conditions_span_the_grid_first_axis_slowest(self):
        got = [(at.load, at.slip, at.yaw) for at in soilbin.conditions(load=[1, 2], slip=np.array([0.1, 0.2]), yaw=0.3)]
        self.assertEqual(got, [(1, 0.1, 0.3), (1, 0.2, 0.3), (2, 0.1, 0.3), (2, 0.2, 0.3)])

    def test_the_steepest_slope_is_the_commands(self):
        limits = command("limits", "--tire", "rover-wheel", "--soil", "dry-sand", "--load", "64.68N")["rows"][0]
        slope = bekker_wong.steepest_slope(ROVER, AT)
        self.assertEqual(slope, limits["steepest_slope"])
        self.assertEqual(slope.std_error, limits["std_error"]["steepest_slope"])
        self.assertEqual(math.degrees(slope), math.degrees(slope.value), "it counts as a float")
        self.assertRegex(str(slope), r"^0\.\d+ ± 0\.\d+$")
        self.assertLess(bekker_wong.steepest_slope(ROVER, AT, drawbar=5.0), slope)
        again = pickle.loads(pickle.dumps(slope))
        self.assertEqual((again, again.std_error), (slope, slope.std_error))

    def test_pulls_and_slips_of_limits_carry_the_commands_errors(self):
        second = command("limits", "--tire", "rover-wheel", "--soil", "dry-sand", "--load", "64.68N")["rows"][0]["slopes"][1]
        uphill = AT.replace(longitudinal_incline=second["longitudinal_incline"])
        peak = bekker_wong.largest_pull(ROVER, uphill)
        self.assertEqual((peak.drawbar_pull, peak.drawbar_pull_std_error, peak.slip),
                         (second["largest_pull"], second["std_error"]["largest_pull"], second["slip_of_largest_pull"]))
        slip = bekker_wong.slip_for_pull(ROVER, uphill)
        self.assertEqual((slip, slip.std_error), (second["slip"], second["std_error"]["slip"]))
        self.assertRegex(repr(peak), r"drawbar_pull=[0-9.]+ ± [0-9.]+ N")
        near = bekker_wong.slip_for_pull(ROVER, uphill, peak.drawbar_pull - 0.1 * peak.drawbar_pull_std_error)
        self.assertTrue(math.isnan(near.std_error))
        self.assertRegex(repr(near), r"^0\.\d+$")

    def test_limits_take_a_condition_as_keywords_and_refuse_in_plain_words(self):
        self.assertEqual(bekker_wong.steepest_slope(ROVER, load=64.68), bekker_wong.steepest_slope(ROVER, AT))
        self.assertEqual(bekker_wong.slip_for_pull(ROVER, load=64.68), bekker_wong.slip_for_pull(ROVER, AT, 0.0))
        self.assertEqual(bekker_wong.largest_pull(ROVER, load=64.68).slip, bekker_wong.largest_pull(ROVER, AT).slip)
        for wrong, words in ((lambda: soilbin.estimate("rover-wheel", load=65, slip=0.2), "expected a Scenario"),
                             (lambda: soilbin.estimate(ROVER, load=[65, 80], slip=0.2), "not 2 of them")):
            with self.assertRaisesRegex(TypeError, words):
                wrong()

    def test_predictions_and_their_errors_are_the_commands(self):
        known = command("predict", "cmu-smooth")
        predicted = compare.predict("cmu-smooth")
        for ours, theirs in zip(predicted.sinkage_std_error.dropna(), (r for r in known["rows"] if not r.get("error"))):
            self.assertAlmostEqual(ours, theirs["std_error"]["sinkage"], delta=1e-9)
        errors = compare.error_frame(predicted)
        for channel, row in known["error"].items():
            self.assertAlmostEqual(errors.loc[channel, "rmse"], row["rmse"], delta=1e-9 * row["rmse"])

    def test_every_name_of_the_library_can_be_read(self):
        for shelf, read in ((soilbin.Shelf.tires, soilbin.find_tire), (soilbin.Shelf.soils, soilbin.find_soil),
                            (soilbin.Shelf.studies, soilbin.find_case), (soilbin.Shelf.vehicles, soilbin.find_vehicle),
                            (soilbin.Shelf.measured, compare.find_campaign)):
            self.assertGreater(len(soilbin.names(shelf)), 0)
            for name in soilbin.names(shelf):
                self.assertEqual(read(name).name, name)
            self.assertEqual(soilbin.names(shelf.name), soilbin.names(shelf))
        with self.assertRaisesRegex(soilbin.InputError, "no shelf 'wheels'"):
            soilbin.names("wheels")

    def test_the_resolved_case_comes_back(self):
        text = soilbin.find_case("rover-climb").yaml()
        self.assertEqual(soilbin.parse_case(text).yaml(), text)


class Warnings(unittest.TestCase):
    WORDS = ("--soil", "sandy-loam", "--radius", "670mm", "--width", "430mm", "--inflation-pressure", "150kPa", "--load", "37.5kN")

    def setUp(self):
        self.wheel = soilbin.Scenario(soilbin.Tire(name="wheel", radius=0.67, width=0.43), "sandy-loam")

    def test_an_estimate_warns_of_what_the_command_warns_of(self):
        known = command("estimate", *self.WORDS, "--slip", "20%")["warnings"]
        self.assertTrue(known)
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            soilbin.estimate(self.wheel, load=37.5e3, slip=0.2, inflation_pressure=150e3)
        self.assertEqual([str(one.message) for one in caught], known)
        self.assertTrue(all(one.category is soilbin.SoilbinWarning and one.filename == __file__ for one in caught))

    def test_a_tire_with_a_pressure_is_flexible_or_rigid_as_the_commands(self):
        tire, load = "truck-335-65r22", 20e3
        words = ("--tire", tire, "--soil", "sandy-loam", "--load", "20kN")
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            wheel = soilbin.Scenario(tire, "sandy-loam")
            for flags, left_out in ((), {}), (("--rigid",), {"rigid": True}), (("--no-lugs",), {"no_lugs": True}):
                pull = command("estimate", *words, "--slip", "20%", *flags)["rows"][0]["drawbar_pull"]
                self.assertEqual(soilbin.estimate(wheel, load=load, slip=0.2, **left_out).drawbar_pull.value, pull)
                frame = soilbin.sweep(wheel, soilbin.conditions(load=load, slip=0.2), progress=None, **left_out)
                self.assertEqual(frame.drawbar_pull[0], pull)
                explained = bekker_wong.explain(wheel, load=load, slip=0.2, **left_out)
                self.assertEqual(explained.result.drawbar_pull.value, pull)
                slope = command("limits", *words, *flags)["rows"][0]["steepest_slope"]
                self.assertEqual(bekker_wong.steepest_slope(wheel, load=load, **left_out), slope)
            with self.assertRaisesRegex(soilbin.InputError, "a rigid wheel has no inflation pressure"):
                soilbin.estimate(self.wheel, rigid=True, load=37.5e3, slip=0.2, inflation_pressure=150e3)
        model = soilbin.bekker_wong.BekkerWong().evaluate(wheel, AT.replace(load=load, slip=0.2))
        bare = command("estimate", *words, "--slip", "20%", "--effect", "none")["rows"][0]["drawbar_pull"]
        self.assertEqual(model.drawbar_pull.value, bare, "a model keeps to the declared effects")

    def test_a_frame_keeps_them(self):
        known = command("estimate", *self.WORDS, "--slip", "10%,20%")["warnings"]
        with self.assertWarns(soilbin.SoilbinWarning):
            frame = soilbin.sweep(self.wheel, soilbin.conditions(load=37.5e3, slip=[0.1, 0.2], inflation_pressure=150e3))
        self.assertEqual(frame.attrs["warnings"], known)
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            frame = soilbin.run_study("rover-slip", progress=None)
        self.assertEqual(frame.attrs["warnings"], [str(one.message) for one in caught])


class Values(unittest.TestCase):
    def test_a_changed_copy_leaves_the_first_alone(self):
        wide = ROVER.tire.replace(width=0.22)
        self.assertEqual((wide.width, ROVER.tire.width, wide.radius), (0.22, 0.11, ROVER.tire.radius))

    def test_a_number_does_for_an_estimate(self):
        sand = ROVER.soil.semi_empirical.replace(k_phi=8e6, cohesion=soilbin.Estimate(500, 100))
        self.assertEqual((sand.k_phi.value, sand.k_phi.std_error), (8e6, 0.0))
        self.assertEqual((float(sand.cohesion), sand.cohesion.std_error), (500.0, 100.0))

    def test_what_is_shown_carries_its_error(self):
        self.assertEqual(repr(soilbin.Estimate(28.04, 1.5)), "Estimate(28.0 ± 1.5)")
        self.assertEqual(str(soilbin.Estimate(28.04)), "28.04")
        self.assertRegex(repr(soilbin.estimate(ROVER, AT)), r"TractionResult\(drawbar_pull=\S+ ± \S+ N, torque=.*lateral_force=0 N")
        self.assertIn("friction_angle=Estimate(0.489 ± 0.049)", repr(ROVER.soil.semi_empirical))
        with self.assertRaises(soilbin.InputError):
            soilbin.Estimate(1.0, -0.1)

    def test_stress_angles_that_nobody_gives_are_usual_ones(self):
        sand = ROVER.soil.semi_empirical
        known = {name: getattr(sand, name) for name in ("exponent", "k_c", "k_phi", "cohesion", "friction_angle", "shear_modulus")}
        made = soilbin.SemiEmpiricalSoil(**known)
        self.assertEqual((made.stress_angle_c1.value, made.stress_angle_c1.std_error), (0.30, 0.15))
        self.assertEqual(soilbin.SemiEmpiricalSoil(**known, stress_angle_c1=0.2).stress_angle_c1.std_error, 0.0)

    def test_attributes_tell_meaning_unit_and_range(self):
        self.assertEqual(soilbin.Tire.radius.__doc__, "radius to the tread base, without lugs [m], above 0 m")
        self.assertIn("[N/m^(n+1)]", soilbin.SemiEmpiricalSoil.k_c.__doc__)
        self.assertIn("[rad]", soilbin.OperatingCondition.yaw.__doc__)

    def test_everything_public_has_a_docstring(self):
        for module in (soilbin, bekker_wong, dem, compare):
            for name in module.__all__:
                if not name.startswith("__"):
                    self.assertTrue((getattr(module, name).__doc__ or "").strip(), f"{module.__name__}.{name}")


class Lessons(unittest.TestCase):
    def said(self, answer, right=172.2):
        with contextlib.redirect_stdout(io.StringIO()) as text:
            verdict = lessons.check(answer, right, hint="Look at b.")
        return verdict, text.getvalue()

    def test_an_answer_is_right_within_a_share(self):
        self.assertEqual(self.said(None), (None, "No answer yet.\n"))
        self.assertEqual(self.said(np.float64(174)), (True, "Right: 172.2.\n"))
        self.assertEqual(self.said(180), (False, "Not yet: 180 is close. Look at b.\n"))
        self.assertEqual(self.said(86.1), (False, "Not yet: 86.1 is far off. Look at b.\n"))

    def test_what_is_not_one_number_is_told_how_to_write_one(self):
        how = "write one number, without quotes and with a decimal point, such as 172.2.\n"
        self.assertEqual(self.said("172,2"), (False, f"Not yet: '172,2' is a text; {how}"))
        self.assertEqual(self.said((172, 2)), (False, f"Not yet: (172, 2) is several numbers; {how}"))
        self.assertEqual(self.said([1, 2]), (False, f"Not yet: an answer of the type list is not a number; {how}"))

    def test_a_solution_tests_itself_in_silence(self):
        with contextlib.redirect_stdout(io.StringIO()) as text:
            self.assertTrue(lessons.is_right(172.2, 172.2))
            self.assertTrue(lessons.is_right(0, 0))
            self.assertFalse(lessons.is_right(180, 172.2))
            self.assertTrue(lessons.is_right(180, 172.2, within=0.05))
        self.assertEqual(text.getvalue(), "")


class Errors(unittest.TestCase):
    def test_a_file_is_named_with_line_and_column(self):
        with self.assertRaises(soilbin.InputError) as caught:
            soilbin.parse_case("format: soilbin-case/1\nnmae: x\n", "mine.yaml")
        error = caught.exception
        self.assertEqual((error.file, error.line, error.column), ("mine.yaml", 2, 1))
        self.assertIn("did you mean 'name'?", str(error))
        self.assertIsInstance(error, ValueError)

    def test_names_and_words_get_the_nearest_right_one(self):
        for wrong, right in ((lambda: soilbin.find_soil("dry-snad"), "dry-sand"),
                             (lambda: compare.find_campaign("cmu-smoth"), "cmu-smooth"),
                             (lambda: ROVER.with_effects(["slip_sinkag"]), "slip_sinkage"),
                             (lambda: soilbin.EffectChoice("multipass", "stifer"), "stiffer")):
            with self.assertRaises(soilbin.InputError) as caught:
                wrong()
            self.assertIn(right, str(caught.exception))
            self.assertIsNone(caught.exception.line)

    def test_a_percentage_is_answered_with_the_share(self):
        with self.assertRaisesRegex(soilbin.InputError, r"slip: 20 is out of range, which is -1 \.\. 1, did you mean 0\.2 \(20 %\)\?"):
            soilbin.estimate(ROVER, load=65, slip=20)
        for wrong in (lambda: soilbin.estimate(ROVER, load=65, slip=200), lambda: ROVER.soil.semi_empirical.replace(exponent=soilbin.Estimate(20))):
            with self.assertRaises(soilbin.InputError) as caught:
                wrong()
            self.assertNotIn("did you mean", str(caught.exception))

    def test_keywords_are_checked(self):
        with self.assertRaisesRegex(TypeError, "did you mean 'radius'"):
            soilbin.Tire(raduis=1, radius=1, width=1)
        with self.assertRaisesRegex(TypeError, "OperatingCondition has no attribute 'laod', did you mean 'load'"):
            soilbin.estimate(ROVER, laod=65, slip=0.2)
        with self.assertRaisesRegex(AttributeError, "did you mean 'radius'"):
            ROVER.tire.raduis = 0.1
        with self.assertRaisesRegex(TypeError, "missing keyword argument 'width'"):
            soilbin.Tire(radius=1)
        for value in (-0.1, 0.0, math.nan, math.inf):
            with self.assertRaises(soilbin.InputError):
                soilbin.Tire(radius=value, width=1)
        with self.assertRaisesRegex(soilbin.InputError, "either 'rim_speed' or 'torque'"):
            soilbin.Controller(rim_speed=1, torque=1)

    def test_a_number_in_the_place_of_a_condition_is_told_its_name(self):
        for ask in (bekker_wong.slip_for_pull, bekker_wong.steepest_slope):
            with self.assertRaisesRegex(TypeError, r"at: expected an OperatingCondition, not 5; the pull is drawbar=\.\.\."):
                ask(ROVER, 5, load=60)
        with self.assertRaisesRegex(TypeError, "at: expected an OperatingCondition, not 80; numbers go by their names"):
            soilbin.estimate(ROVER, 80)

    def test_without_pandas_it_says_what_to_install(self):
        code = "import sys; sys.modules['pandas'] = None; import soilbin"
        done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
        self.assertIn("soilbin needs numpy and pandas: apt install python3-pandas, or pip install pandas", done.stderr)

    def test_a_text_for_a_number_is_told_in_words(self):
        for wrong, said in ((lambda: soilbin.estimate(ROVER, load="65 N", slip=0.2),
                             "load: expected a number in N, not the text '65 N'; write 65"),
                            (lambda: soilbin.Tire(radius="90 mm", width=0.1),
                             "radius: expected a number in m, not the text '90 mm'; write 0.09"),
                            (lambda: soilbin.Tire(radius="90 kPa", width=0.1),
                             "radius: expected a number in m, not the text '90 kPa'"),
                            (lambda: AT.replace(slip="20 %"), "slip: expected a number, not the text '20 %'; write 0.2")):
            with self.assertRaises(TypeError) as caught:
                wrong()
            self.assertEqual(str(caught.exception), said)

    def test_quantities_of_pint_are_taken_where_there_is_pint(self):
        try:
            import pint
        except ImportError:
            self.skipTest("python3-pint is not installed")
        unit = pint.UnitRegistry()
        tire = soilbin.Tire(radius=90 * unit.mm, width=11 * unit.cm)
        self.assertAlmostEqual(tire.radius, 0.09, delta=1e-15)
        at = AT.replace(load=65 * unit.newton, yaw=10 * unit.degree, slip=20 * unit.percent if "percent" in unit else 0.2)
        self.assertAlmostEqual(at.yaw, math.radians(10), delta=1e-15)
        self.assertEqual(at.load, 65.0)
        with self.assertRaisesRegex(soilbin.InputError, "radius: expected a length, not 90 kilopascal"):
            soilbin.Tire(radius=90 * unit.kPa, width=0.1)

    def test_a_wheel_that_buries_itself_has_no_solution(self):
        with self.assertRaisesRegex(soilbin.NoSolution, "sink deeper"):
            soilbin.estimate(ROVER, load=1e6, slip=0.2)

    def test_a_grain_pressed_too_deep_stops_the_run(self):
        sim = dem.Simulation(dem.Material(young=1e6), dem.Interaction(), dt=1e-5)
        sim.add_grain((0, 0, 0), 0.01)
        sim.add_grain((0.012, 0, 0), 0.01)
        with self.assertRaises(soilbin.RunStopped):
            sim.run(1)


class WrongArguments(unittest.TestCase):
    def test_they_are_told_in_words(self):
        for wrong, said in ((lambda: soilbin.Tire(radius=None, width=0.1), "radius: expected a number in m, not None"),
                            (lambda: soilbin.estimate(ROVER, load={}, slip=0.2), "load: expected a number in N, not {}"),
                            (lambda: AT.replace(**{"pass": 1.5}), "pass: expected a whole number, not 1.5"),
                            (lambda: AT.replace(slip=[0.1]), r"slip: expected a number, not \[0.1\]"),
                            (lambda: ROVER.tire.replace(name=3), "name: expected a text, not 3"),
                            (lambda: ROVER.soil.semi_empirical.replace(k_c="much"), "k_c: expected a number"),
                            (lambda: ROVER.tire.replace(lugs=5), "lugs: expected a Lugs, not 5")):
            with self.assertRaisesRegex(TypeError, "^" + said):
                wrong()

    def test_a_name_is_a_line_without_control_characters(self):
        for name in ("a\nb", "\x1b[2J", "\u009b"):
            with self.assertRaisesRegex(soilbin.InputError, "name: a "):
                ROVER.tire.replace(name=name)

    def test_steps_that_make_no_sense_are_refused(self):
        sand = soilbin.find_soil("paper-sand").granular
        for dt in (-1.0, math.nan, math.inf):
            with self.assertRaises(soilbin.InputError):
                two_spheres(1, dt=dt)
            with self.assertRaises(soilbin.InputError):
                dem.tilting_board(sand, across=4, dt=dt, progress=None)

    def test_counts_that_nobody_means_are_refused_before_they_are_made(self):
        sand = soilbin.find_soil("paper-sand").granular
        for wrong in (lambda: dem.tilting_board(sand, across=46341, progress=None),
                      lambda: dem.direct_shear(sand, packings=2**31 - 1, progress=None),
                      lambda: dem.direct_shear(sand, inertial=1e-300, progress=None),
                      lambda: dem.tilting_board(sand.replace(youngs_modulus=1e20), across=4, progress=None)):
            with self.assertRaises(soilbin.InputError):
                wrong()

    def test_an_object_that_new_alone_made_has_no_value(self):
        for kind in (soilbin.Tire, soilbin.Estimate, soilbin.Soil, dem.Simulation):
            for use in (repr, lambda made: made.width, lambda made: made.value, lambda made: made.time):
                made = kind.__new__(kind)
                try:
                    text = str(use(made))
                except (TypeError, AttributeError):
                    continue
                self.assertIn("object at 0x", text, "Python's own words for it")


class ArgumentsInWords(unittest.TestCase):
    """None, a number and a list where something else is meant: pybind11 answers with C++ signatures."""

    def test_every_function_says_which_argument_is_wrong(self):
        own = [(module, name, getattr(module, name)) for module in (soilbin, bekker_wong, compare, dem)
               for name in module.__all__ if callable(getattr(module, name)) and not isinstance(getattr(module, name), type)]
        asked = 0
        for module, name, function in own:
            for wrong in (None, 1.5, [None]):
                with self.subTest(function=f"{module.__name__}.{name}", wrong=wrong):
                    with self.assertRaises((TypeError, soilbin.InputError)) as raised:
                        function(wrong)
                    said = str(raised.exception)
                    for internal in ("incompatible function arguments", "Invoked with", "has no attribute", "subscriptable",
                                     "iterable"):
                        self.assertNotIn(internal, said)
                    named = said.partition("()")[0]
                    if named != said:
                        self.assertEqual(named, name, "the function that was called, not one that it calls")
                    asked += 1
        self.assertGreater(asked, 80)

    def test_the_words(self):
        for wrong, words in ((lambda: soilbin.find_case(None), "find_case(): name: expected a text, not None"),
                             (lambda: soilbin.find_case(), "find_case(): missing argument 'name': a text"),
                             (lambda: soilbin.find_case("a", "b"), "find_case() takes name; 2 arguments were given"),
                             (lambda: soilbin.find_case(nam="a"), "find_case() takes name, not 'nam'"),
                             (lambda: bekker_wong.bekker_static_sinkage(ROVER, "heavy"),
                              "bekker_static_sinkage(): load: expected a number, not 'heavy'"),
                             (lambda: bekker_wong.fit_plates([1.5], None),
                              "fit_plates(): curves: expected a list of PlateCurve, not [1.5]"),
                             (lambda: soilbin.run_study(None), "run_study(): case: expected a Case or a text, not None"),
                             (lambda: soilbin.sweep(ROVER, None), "sweep(): at: expected a list of OperatingCondition, not None"),
                             (lambda: dem.SoilBin(None), "SoilBin(): packing: expected a whole number, not None"),
                             (lambda: bekker_wong.explain(None),
                              "scenario: expected a Scenario, such as Scenario('rover-wheel', 'dry-sand'), not None"),
                             (lambda: bekker_wong.BekkerWong().evaluate(ROVER, 20),
                              "evaluate(): at: expected an OperatingCondition, not 20"),
                             (lambda: compare.compare_case("paper-straight", record=3),
                              "compare_case(): record: expected a Record or a list of RecordedRun or None, not 3"),
                             (lambda: compare.predict(1.5), "predict(): campaign: expected a Campaign or a text, not 1.5"),
                             (lambda: bekker_wong.drive_frame([]), "drive_frame(): record: expected a DriveRecord, not []")):
            with self.assertRaises(TypeError) as raised:
                wrong()
            self.assertEqual(str(raised.exception), words)

    def test_errors_within_a_function_stay_their_own(self):
        with self.assertRaisesRegex(soilbin.InputError, "no study 'rover-slop'|rover-slip"):
            soilbin.find_case("rover-slop")
        frame = compare.predict("cmu-smooth", progress=None)
        with self.assertRaises(KeyError):
            compare.error_frame(frame.drop(columns=[c for c in frame.columns if c.endswith("_residual")]))


class Processes(unittest.TestCase):
    """Each in a Python of its own, with a clock that ends it."""

    def python(self, code, within=60):
        return subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=within, check=False)

    BOX = """
import soilbin
from soilbin import dem
sand = soilbin.find_soil("paper-sand").granular
def box(threads, progress=None):
    return dem.direct_shear(sand, [20e3], length=5, width=4, height=4, travel=0.05, threads=threads, progress=progress).runs[0].curve["shear_stress"]
"""

    def test_a_child_made_by_fork_works_after_threads_were_used(self):
        done = self.python(self.BOX + """
import multiprocessing
right = box(3)
with multiprocessing.get_context("fork").Pool(2) as pool:
    for got in pool.map(box, [3, 1, 2]):
        assert (got == right).all()
sim = dem.Simulation(dem.Material(), dem.Interaction(), dt=2e-6, threads=3)
for k in range(50):
    sim.add_grain((0.021 * k, 0, 0), 0.01)
sim.run(5)
import os
child = os.fork()
if child == 0:
    sim.run(5)
    os._exit(7)
assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 7
print("alike")
""")
        self.assertEqual((done.returncode, done.stdout), (0, "alike\n"), done.stderr)

    def test_an_interpreter_that_ends_stops_what_a_daemon_computes(self):
        began = time.monotonic()
        done = self.python(self.BOX + """
import threading
started = threading.Event()
def work():
    dem.direct_shear(sand, [20e3], threads=2, progress=lambda share, stage: started.set())
threading.Thread(target=work, daemon=True).start()
def look():
    while True:
        soilbin.sweep(soilbin.Scenario("rover-wheel", "dry-sand"), soilbin.conditions(load=60.0, slip=[0.1] * 100), progress=None)
threading.Thread(target=look, daemon=True).start()
assert started.wait(30)
print("ends")
""")
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "ends\n", ""))
        self.assertLess(time.monotonic() - began, 50)

    def test_two_threads_on_one_simulation_are_refused(self):
        done = self.python("""
import threading
from soilbin import dem
sim = dem.Simulation(dem.Material(), dem.Interaction(), dt=2e-6)
for k in range(200):
    sim.add_grain((0.021 * k, 0, 0), 0.01, velocity=(0.1, 0, 0))
running, said, inside = threading.Event(), [], []
def progress(share, stage):
    inside.append(sim.positions[0, 0])
    running.set()
worker = threading.Thread(target=lambda: sim.run(60_000, progress))
worker.start()
running.wait(30)
for use in (lambda: sim.run(1), lambda: sim.positions, lambda: sim.energy(), lambda: sim.add_grain((0, 1, 0), 0.01), lambda: sim.time):
    try:
        use()
    except RuntimeError as error:
        said.append("at work already" in str(error))
worker.join()
assert said == [True] * 5, said
assert inside, "its own progress may look"
sim.run(1)
print(sim.time > 0.12)
""")
        self.assertEqual((done.returncode, done.stdout), (0, "True\n"), done.stderr)


class Arrays(unittest.TestCase):
    def check_view(self, array, owner):
        self.assertIs(array.base, owner)
        self.assertFalse(array.flags.owndata)
        with self.assertRaises(ValueError):
            array[0] = 1

    def test_stresses_are_views_that_keep_the_result_alive(self):
        result = soilbin.estimate(ROVER, AT)
        patch = result.patch
        self.check_view(patch["normal"], result)
        first = patch["theta"].copy()
        del result
        self.assertTrue(np.array_equal(patch["theta"], first))

    def test_a_drives_samples_are_views_and_a_frame(self):
        case = soilbin.find_case("rover-climb")
        record = bekker_wong.drive_wheel(case.scenario, case.drive, samples=50)
        self.check_view(record.samples["time"], record)
        frame = bekker_wong.drive_frame(record)
        self.assertEqual(record.end, bekker_wong.DriveEnd.stuck)
        self.assertEqual(frame.time.iloc[-1], record.end_time)
        spent = frame[["kinetic", "height", "drawbar_work", "compaction", "shear", "added", "damping"]].sum(axis=1)
        self.assertLess((frame.motor_work - spent).abs().max(), 1e-6 * frame.motor_work.max())

    def test_the_contact_integrates_to_the_load(self):
        rolled = bekker_wong.RollingWheel(ROVER).roll(AT)
        n = rolled.nodes
        load = ROVER.tire.width * np.sum(n["arc"] * (n["sigma"] * np.cos(n["theta"]) + n["tau_x"] * np.sin(n["theta"])))
        self.assertAlmostEqual(load, AT.load, delta=1e-8 * AT.load)
        self.check_view(n["sigma"], rolled)


def two_spheres(steps=4000, dt=2e-6):
    sim = dem.Simulation(dem.Material(), dem.Interaction(restitution=0.5, sliding_friction=0.0), dt=dt)
    sim.add_grain((-0.0101, 0, 0), 0.01, velocity=(0.5, 0, 0))
    sim.add_grain((0.0101, 0, 0), 0.01, velocity=(-0.5, 0, 0))
    sim.run(steps)
    return sim


class Grains(unittest.TestCase):
    def test_two_spheres_part_at_the_restitution(self):
        v = two_spheres().velocities
        self.assertAlmostEqual(v[1, 0] - v[0, 0], 0.5, delta=0.005)
        self.assertEqual(v[0, 0], -v[1, 0])

    def test_arrays_are_in_the_order_of_ids(self):
        sim = dem.Simulation(dem.Material(), dem.Interaction(), dt=1e-6)
        for k in (5, 1, 3):
            sim.add_grain((k, 0, 0), 0.1 * k)
        sim.run(1)
        self.assertTrue(np.array_equal(sim.radii, [0.5, 0.1, 0.30000000000000004]))
        self.assertTrue(np.allclose(sim.positions[:, 0], [5, 1, 3]))

    def test_a_shear_box_has_the_same_bits_for_any_number_of_threads(self):
        sand = soilbin.find_soil("paper-sand").granular
        runs = [dem.direct_shear(sand, [20e3], length=6, width=5, height=5, travel=0.4, threads=n).runs[0] for n in (1, 3)]
        self.assertTrue(np.array_equal(runs[0].curve["shear_stress"], runs[1].curve["shear_stress"]))

    def test_a_triaxial_cell_keeps_its_stress_and_its_sand_resists_by_less_than_a_wall(self):
        sand = soilbin.find_soil("paper-sand").granular
        run = dem.triaxial(sand, [20e3], side=5, height=7, strain=0.05, settling_friction=0.2, progress=None).runs[0]
        self.assertLess(run.isotropic_error, 0.05)
        lateral = (run.curve["lateral_x"] + run.curve["lateral_y"]) / 2
        self.assertLess(abs(lateral.mean() / 20e3 - 1), 0.1)
        self.assertTrue(0.2 < run.peak.value < 1)
        self.assertGreater(run.curve["axial"].max(), 1.5 * 20e3)

    def test_sand_slides_off_a_board_no_later_than_its_friction_lets_it(self):
        sand = soilbin.find_soil("paper-sand").granular
        board = dem.tilting_board(sand, across=6, progress=None)
        self.assertTrue(board.slid)
        self.assertLess(board.onset, np.arctan(sand.grain_tire.sliding_friction) + 0.02)
        self.assertLess(board.onset, board.gone)
        self.assertEqual(board.curve["angle"].size, board.curve["slide"].size)

    def test_a_plate_under_five_grains_wide_is_refused(self):
        sand = soilbin.find_soil("paper-sand").granular
        with self.assertRaisesRegex(soilbin.InputError, "too narrow"):
            dem.plate_sinkage(sand, [3], progress=None)
        with self.assertRaises(soilbin.InputError):
            dem.annular_shear(sand, inner=4, outer=6, progress=None)

    def test_pressure_under_a_plate_grows_with_its_sinkage(self):
        sand = soilbin.find_soil("paper-sand").granular
        plate, = dem.plate_sinkage(sand, [5], sinkage=1, width=2, depth=0.8, progress=None)
        half = plate.curve["pressure"].size // 2
        self.assertGreater(plate.curve["pressure"][half:].mean(), plate.curve["pressure"][:half].mean())


class Stops(RuntimeError):
    """Raised by a progress in these tests."""


class GrainsOfASoil(unittest.TestCase):
    CONTACT = soilbin.ContactPair(restitution=0.5, sliding_friction=0.5, rolling_friction=0.1)
    STICKY = soilbin.ContactPair(restitution=0.5, sliding_friction=0.5, rolling_friction=0.1, work_of_adhesion=20)

    def made(self, **more):
        return soilbin.GranularSoil(**{"grain_density": 2650, "youngs_modulus": 5e7, "poisson_ratio": 0.25,
                                       "grain_grain": self.CONTACT, "grain_tire": self.CONTACT, **more})

    def test_sizes_stand_in_place_of_radii(self):
        sizes = [soilbin.GrainFraction(radius=radius, share=share) for radius, share in ((0.001, 0.4), (0.002, 0.6))]
        grains = self.made(sizes=sizes)
        self.assertEqual((grains.radius_min, grains.radius_max), (0.001, 0.002))
        self.assertIn("sizes:", soilbin.write_soil(soilbin.Soil(name="sand", granular=grains)))
        for wrong in ({}, {"radius_min": 0.001}, {"sizes": sizes, "radius_max": 0.003}, {"sizes": sizes[:1]}):
            with self.assertRaises(soilbin.InputError, msg=str(wrong)):
                self.made(**wrong)

    def test_jkr_goes_with_a_work_of_adhesion(self):
        radii = {"radius_min": 0.001, "radius_max": 0.002}
        grains = self.made(cohesion_law=soilbin.GrainCohesion.jkr, grain_grain=self.STICKY, **radii)
        self.assertEqual(grains.grain_grain.work_of_adhesion, 20)
        for wrong in ({"grain_grain": self.STICKY}, {"cohesion_law": soilbin.GrainCohesion.jkr}):
            with self.assertRaisesRegex(soilbin.InputError, "cohesion_law"):
                self.made(**wrong, **radii)


LIGGGHTS = """units si
variable mu equal 0.55   # of sand on sand
fix m1 all property/global youngsModulus peratomtype 1e7 5e6
fix m2 all property/global poissonsRatio peratomtype 0.25 0.45
fix m3 all property/global coefficientRestitution peratomtypepair 2 &
    0.3 0.4 &
    0.4 0.5
fix m4 all property/global coefficientFriction peratomtypepair 2 ${mu} 0.6 0.6 0.7
fix m5 all property/global coefficientRollingFriction peratomtypepair 2 0.1 0.2 0.2 0.3
fix m6 all property/global coefficientRollingViscousDamping peratomtypepair 2 0.3 0.3 0.3 0.3
fix m7 all property/global cohesionEnergyDensity peratomtypepair 2 1000 0 0 0
pair_style gran model hertz tangential history cohesion sjkr rolling_friction epsd
fix g all gravity 1.62 vector 0.0 0.0 -1.0
fix p1 all particletemplate/sphere 15485863 atom_type 1 density constant 2650 radius constant 0.004
fix p2 all particletemplate/sphere 15485867 atom_type 1 density constant 2650 radius constant 0.002
fix d all particledistribution/discrete 32452843 2 p1 0.3 p2 0.7
"""


class LiggghtsScripts(unittest.TestCase):
    def soil(self, text, **asked):
        with tempfile.TemporaryDirectory() as folder, warnings.catch_warnings(record=True) as told:
            warnings.simplefilter("always")
            script = Path(folder) / "in.sand"
            script.write_text(text)
            return soilbin.soil_from_liggghts(script, **asked), [str(one.message) for one in told]

    def test_their_materials_are_a_soil(self):
        soil, told = self.soil(LIGGGHTS, grains=1, tire=2)
        grains = soil.granular
        self.assertEqual((soil.name, grains.youngs_modulus, grains.poisson_ratio, grains.gravity), ("sand", 1e7, 0.25, 1.62))
        self.assertEqual((grains.grain_grain.restitution, grains.grain_grain.sliding_friction), (0.3, 0.55))
        self.assertEqual((grains.grain_tire.restitution, grains.grain_tire.rolling_friction), (0.4, 0.2))
        self.assertEqual(grains.rolling_resistance, soilbin.RollingResistance.elastic_plastic)
        self.assertEqual(grains.grain_grain.cohesion, 2000, "over 2 pi R* delta there, pi R* delta here")
        self.assertEqual([(one.radius, one.share) for one in grains.sizes], [(0.002, 0.7), (0.004, 0.3)])
        self.assertEqual(len(told), 1)
        self.assertIn("not carried over: the tire's own stiffness", told[0])
        self.assertIn("sizes:", soilbin.write_soil(soil))

    def test_what_is_not_carried_over_is_told_and_what_cannot_be_is_refused(self):
        told = self.soil(LIGGGHTS.replace("epsd", "epsd2").replace("history", "no_history"))[1]
        self.assertEqual(len(told), 3, told)
        for old, new, why in (("units si", "units cgs", "no line 'units si'"), ("model hertz", "model hooke", "in.sand:12: the normal law"),
                              ("${mu} 0.6", "${nu} 0.6", r"in.sand:8: expected a number, not '\$\{nu\}'"),
                              ("0.3 0.4 &", "0.3 &", "in.sand:5: coefficientRestitution has 3 values"),
                              ("youngsModulus", "youngModulus", "no property/global youngsModulus"),
                              ("discrete 3", "discrete/numberbased 3", "by number")):
            with self.assertRaisesRegex(soilbin.InputError, why):
                self.soil(LIGGGHTS.replace(old, new))
        with self.assertRaisesRegex(soilbin.InputError, "youngsModulus has 2 types|no particletemplate"):
            self.soil(LIGGGHTS, grains=3)


class LongWork(unittest.TestCase):
    def box(self, progress):
        sand = soilbin.find_soil("paper-sand").granular
        return dem.direct_shear(sand, [20e3], length=12, width=8, height=10, threads=1, progress=progress)

    def test_progress_is_told_and_may_stop_the_work(self):
        told = []

        def progress(share, stage):
            told.append((share, stage))
            if len(told) == 3:
                raise Stops()

        with self.assertRaises(Stops):
            self.box(progress)
        self.assertEqual(len(told), 3)
        self.assertTrue(all(0 <= share <= 1 for share, _ in told))

    def test_ctrl_c_stops_each_kind_of_long_work(self):
        case = soilbin.find_case("rover-slip")
        many = soilbin.conditions(load=60.0, slip=np.linspace(0, 0.5, 50_000))
        for work in (lambda: self.box(None), lambda: compare.run_loop("cmu-smooth", progress=None),
                     lambda: soilbin.sweep(case.scenario, many, progress=None)):
            timer = threading.Timer(0.4, os.kill, (os.getpid(), signal.SIGINT))
            began = time.monotonic()
            timer.start()
            with self.assertRaises(KeyboardInterrupt):
                work()
            self.assertLess(time.monotonic() - began, 20)

    def test_other_threads_go_on_meanwhile(self):
        turns, done = [], threading.Event()

        def count():
            while not done.is_set():
                turns.append(1)
                time.sleep(0.001)

        def stop_later(share, stage):
            if len(turns) > 20:
                raise Stops()

        other = threading.Thread(target=count)
        other.start()
        try:
            with self.assertRaises(Stops):
                self.box(stop_later)
        finally:
            done.set()
            other.join()


class Calibrations(unittest.TestCase):
    """Four grains across, two boards, soft grains: seconds of work."""
    SOIL = str(Path(__file__).parents[1] / "fixtures/pebbles.yaml")
    ASKED = {"targets": {"board_angle": math.radians(31.47)}, "across": 4, "packings": 2, "threads": 1, "runs": 10,
             "progress": None}

    def test_stopped_it_goes_on_from_its_store_and_says_what_the_command_says(self):
        with tempfile.TemporaryDirectory() as folder:
            store = Path(folder) / "store.json"
            told = []

            def stop_in_the_third_run(share, stage):
                told.append(share)
                if "run 3 of" in stage:
                    raise Stops()

            with self.assertRaises(Stops):
                compare.calibrate(self.SOIL, "tire", store=store, **{**self.ASKED, "progress": stop_in_the_third_run})
            self.assertTrue(all(0 <= share < 0.4 for share in told))
            found = compare.calibrate(self.SOIL, "tire", store=store, **self.ASKED)
            self.assertEqual([run.from_store for run in found.runs[:4]], [True, True, False, False])
            done = subprocess.run([COMMAND, "calibrate", self.SOIL, "--contact", "tire", "--target",
                                   "board_angle=31.47deg", "--across", "4", "--packings", "2", "--threads", "1",
                                   "--runs", "10", "--store", store, "--json"], capture_output=True, text=True)
            said = json.loads(done.stdout)
            self.assertTrue(all(run["from_store"] for run in said["runs"]))
        frame = compare.calibration_frame(found)
        self.assertEqual(len(frame), len(said["runs"]))
        mine = json.loads(found.json())
        for told in (mine, said):
            del told["sentences"]  # they say how many runs were made now
            for run in told["runs"]:
                del run["from_store"]
        self.assertEqual(mine, said)
        rows = compare.variance_frame(found, "board_angle")
        self.assertEqual(list(rows["source"][:3]), ["restitution", "sliding_friction", "rolling_friction"])
        self.assertTrue((rows["range"][:3] >= 0).all())
        test = found.left_out["board_angle"]
        np.testing.assert_allclose(test["standardised"], test["residual"] / test["sd"])
        soil = found.soil()
        self.assertEqual(soil.granular.grain_tire.sliding_friction, found.best.values["sliding_friction"])

    def test_what_makes_no_sense_is_refused(self):
        for wrong in ({"contact": "tyre"}, {"contact": "tire"}, {"targets": {"angle": 0.5}}, {"keep": ["cohesive"]},
                      {"vary": {"sliding_friction": (0.8, 0.2)}}, {"design": "L8"}, {"strength": "top"}, {"test": "box"}):
            with self.assertRaises(soilbin.InputError, msg=str(wrong)):
                compare.calibrate("paper-sand", **{"progress": None, **wrong})
        with self.assertRaises(soilbin.InputError):
            compare.calibrate("dry-sand", targets={"friction_angle": 0.5}, progress=None)


class Recording(unittest.TestCase):
    def case(self):
        grains = soilbin.GranularSoil(
            radius_min=0.008, radius_max=0.012, grain_density=2500, youngs_modulus=5e6, poisson_ratio=0.2,
            grain_grain=soilbin.ContactPair(restitution=0.4, sliding_friction=0.5, rolling_friction=0.1),
            grain_tire=soilbin.ContactPair(restitution=0.4, sliding_friction=0.5, rolling_friction=0.1))
        case = soilbin.find_case("rover-slip")
        case.scenario.soil = case.scenario.soil.replace(granular=grains)
        case.scenario.tire = soilbin.Tire(radius=0.1, width=0.08)
        case.study.conditions = [soilbin.OperatingCondition(load=20.0, slip=slip, speed=0.3) for slip in (0.0, 0.2)]
        return case

    def test_runs_are_kept_stopped_gone_on_with_and_told_as_a_campaign(self):
        case = self.case()
        with tempfile.TemporaryDirectory() as folder:
            bin = dem.SoilBin(beds=folder, threads=1, length=0.6, width=0.16, depth=0.06, behind=0.12, ahead=0.12,
                              lowering=0.1, resting=0.05)
            whole, file = (Path(folder) / name for name in ("whole.json", "record.json"))
            dem.record_runs(case, whole, bin, packings=2, progress=None)

            def stop_in_the_second(share, stage):
                if stage == "run 2 of 4, driving":
                    raise Stops()

            with self.assertRaises(Stops):
                dem.record_runs(case, file, bin, packings=2, progress=stop_in_the_second)
            self.assertEqual(len(compare.read_record(file).runs), 1)
            self.assertTrue(list(Path(folder).glob("run-*.h5")), "the run that was stopped is kept too")
            record = dem.record_runs(case, file, bin, packings=2, progress=None)
            self.assertFalse(list(Path(folder).glob("run-*.h5")))
            mine, theirs = (compare.record_frame(r).drop(columns="seconds") for r in (record, whole))
            self.assertTrue(mine.equals(theirs))
            self.assertEqual(list(mine["packing"]), [1, 1, 2, 2])  # the order of a run list: bed by bed
            tile = dem.SoilBin(beds=folder, threads=1, patch=True, length=0.3, width=0.16, depth=0.06, behind=0.12,
                               ahead=0.16, travel=0.1, lowering=0.1, resting=0.05)
            run = dem.run_wheel(tile, case.scenario, case.study.conditions[0], None)
            self.assertGreater(run.patch.grains, 100)
            self.assertLess(run.patch.disturbed, 0.02)
            other = dem.SoilBin(beds=folder, threads=1, length=0.7, width=0.16, depth=0.06)
            with self.assertRaises(soilbin.InputError):
                dem.record_runs(case, file, other, progress=None)
            told = compare.tell_campaign([record], hide=["bin"], name="by-hand")
            compare.write_campaign(told, Path(folder) / "by-hand")
            back = compare.find_campaign(str(Path(folder) / "by-hand"))
        self.assertEqual(len(back.runs), 4)
        self.assertIsNone(back.bin)
        self.assertEqual(sorted(compare.runs_frame(back)["torque"]), sorted(mine["torque"]))
        with self.assertRaises(soilbin.InputError):
            compare.tell_campaign(record, hide=["the truth"])


class Exports(unittest.TestCase):
    GRID = soilbin.conditions(load=[50.0, 65.0], slip=[0.0, 0.2, 0.4])
    ROVER_BY_FLAGS = ("--tire", "rover-wheel", "--soil", "dry-sand")

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def test_a_table_is_the_commands(self):
        header, csv, hdf5 = (self.folder / name for name in ("made/rover.h", "rover.csv", "rover.h5"))
        table = soilbin.export_table(ROVER, self.GRID, header=header, csv=csv, hdf5=str(hdf5))
        known = command("export", "table", *self.ROVER_BY_FLAGS, "--load", "50N,65N", "--slip", "0%,20%,40%")
        self.assertEqual(table["channels"], known["channels"])
        self.assertEqual([axis["nodes"] for axis in table["axes"]], [[50, 65], [0, 0.2, 0.4]])
        pull = soilbin.estimate(ROVER, load=65, slip=0.2).drawbar_pull
        self.assertEqual(np.reshape(table["channels"][0]["values"], (2, 3))[1, 1], pull.value)
        self.assertEqual(table["channels"][0]["std_errors"][4], pull.std_error)
        self.assertIn("rover_lookup(double load, double slip", header.read_text())
        self.assertEqual(len(csv.read_text().splitlines()), 7)
        self.assertEqual(hdf5.read_bytes()[1:4], b"HDF")
        with self.assertWarnsRegex(soilbin.SoilbinWarning, "rft has no cohesion"):
            self.assertEqual(soilbin.export_table(ROVER, self.GRID, model="rft")["model"], "rft")

    def test_a_soil_for_chrono_comes_back(self):
        file = self.folder / "scm.json"
        document = soilbin.export_scm("dry-sand", file)
        self.assertEqual(document, json.loads(file.read_text()))
        self.assertEqual(document["Soil parameters"], command("export", "scm", "dry-sand")["Soil parameters"])
        self.assertAlmostEqual(soilbin.find_soil(str(file)).semi_empirical.k_phi.value,
                               soilbin.find_soil("dry-sand").semi_empirical.k_phi.value, delta=1)

    def test_a_wheel_for_gazebo_and_its_map(self):
        wheel = soilbin.export_gazebo(ROVER, load=65, slip=0.2)
        known = command("export", "gazebo", *self.ROVER_BY_FLAGS, "--load", "65N", "--slip", "20%")
        self.assertEqual(wheel, known)
        mapped = soilbin.export_gazebo(ROVER, load=65, slip=0.2, map=self.folder / "map.png",
                                       soils=["lunar-regolith", soilbin.find_soil("cmu-sand")], size=20)
        self.assertEqual([one["soil"] for one in mapped["map"]["soils"]], ["dry-sand", "lunar-regolith", "cmu-sand"])
        self.assertEqual(mapped["map"]["size"], 20)
        self.assertEqual((self.folder / "map.png").read_bytes()[1:4], b"PNG")

    def test_a_unit_of_fmi(self):
        file = self.folder / "rover.fmu"
        unit = soilbin.export_fmi(ROVER, self.GRID, file)
        self.assertEqual(unit["table"]["format"], "soilbin-force-table/1")
        with zipfile.ZipFile(file) as packed:
            self.assertIsNone(packed.testzip())
            self.assertIn(unit["guid"], packed.read("modelDescription.xml").decode())
            self.assertEqual("binaries/linux64/rover.so" in packed.namelist(), unit["compiled"])

    def test_what_can_not_be_exported_is_said(self):
        with self.assertRaisesRegex(soilbin.InputError, "leave 1 of the 6 nodes of load x slip out"):
            soilbin.export_table(ROVER, self.GRID[1:])
        with self.assertRaisesRegex(soilbin.InputError, "no model 'dem' here: there are bekker_wong"):
            soilbin.export_table(ROVER, self.GRID, model="dem")
        with self.assertRaisesRegex(soilbin.InputError, "begin at 0 %"):
            soilbin.export_fmi(ROVER, soilbin.conditions(load=65.0, slip=[0.1, 0.2]), self.folder / "a.fmu")
        with self.assertRaisesRegex(soilbin.NoSolution, "soil 'snow-sweden'"):
            soilbin.export_gazebo(ROVER, load=65, slip=0.2, soils=["snow-sweden"])
        with self.assertRaisesRegex(soilbin.InputError, "no semi_empirical values"):
            soilbin.export_scm(soilbin.Soil(name="loam", cone_index=soilbin.Estimate(3e5, 3e4)))
        with self.assertRaisesRegex(RuntimeError, "/proc/none"):
            soilbin.export_table(ROVER, self.GRID, csv="/proc/none/table.csv")

    def test_the_guides_python_runs(self):
        page = (Path(__file__).parents[2] / "docs/guide/export.md").read_text()
        blocks = re.findall(r"```python\n(.*?)```", page, re.DOTALL)
        self.assertTrue(blocks)
        with contextlib.chdir(self.folder):
            for block in blocks:
                exec(block, {})  # as a reader would
        self.assertEqual(sorted(file.name for file in self.folder.iterdir()), ["map.png", "rover.fmu", "rover.h", "scm.json"])


class Vehicles(unittest.TestCase):
    def rover(self, slope=0.0):
        rover = soilbin.find_vehicle("rover")
        rover.condition.slope = math.radians(slope)
        return rover

    def test_a_vehicle_is_the_commands(self):
        answer = soilbin.vehicle_on_soil(self.rover(5))
        known = command("vehicle", "rover", "--slope", "5deg")
        self.assertEqual(answer["steepest"], known["steepest"])
        self.assertEqual(answer["pulls"], known["pulls"])
        frame = soilbin.wheels_frame(answer)
        self.assertEqual(list(frame.wheel), ["front left", "front right", "rear left", "rear right"])
        self.assertEqual(list(frame["sinkage.value"]), [w["sinkage"]["value"] for w in known["steady"]["wheels"]])

    def test_one_that_does_not_travel_says_why(self):
        answer = soilbin.vehicle_on_soil(self.rover(40))
        self.assertEqual(answer["failure"]["why"], "pull")
        with self.assertRaisesRegex(ValueError, "does not travel: its wheels pull too little"):
            soilbin.wheels_frame(answer)

    def test_a_vehicle_of_values_is_the_files(self):
        wheel = soilbin.Tire(name="rover 0.5 m", radius=0.25, width=0.2)
        made = soilbin.Vehicle(
            name="rover", mass=73.4, centre_of_gravity=soilbin.VehiclePoint(x=0.6, z=0.6),
            drive_line=soilbin.DriveLine.motors, soil="grc-1", condition=soilbin.VehicleCondition(speed=0.1),
            axles=[soilbin.VehicleAxle(name="front", x=1.2, track=1.3, steered=True, tire=wheel),
                   soilbin.VehicleAxle(name="rear", x=0.0, track=1.3, tire=wheel)])
        self.assertEqual(soilbin.vehicle_on_soil(made)["steady"], soilbin.vehicle_on_soil(self.rover())["steady"])
        self.assertIs(made.axles[0].steered, True)

    def test_a_drive_is_the_commands(self):
        rover = self.rover(5)
        rover.drive = soilbin.VehicleDrive(duration=10.0)
        drive = soilbin.drive_vehicle(rover, 100)
        self.assertEqual(len(drive["samples"]["time_s"]), 101)
        self.assertLess(drive["travelled"], 0.1 * 10.0)
        known = command("vehicle", "rover", "--drive", "--slope", "5deg")
        self.assertEqual(soilbin.drive_vehicle(self.rover(5))["travelled"], known["travelled"])

    def test_a_turn_is_the_commands(self):
        turn = soilbin.turn_vehicle(self.rover(), radius=3.0)
        known = command("vehicle", "rover", "--turn", "--radius", "3m")
        self.assertEqual(turn["turn"], known["turn"])
        with self.assertRaisesRegex(soilbin.InputError, "not both"):
            soilbin.turn_vehicle(self.rover(), radius=3.0, steer=0.2)

    def test_beside_measurements_is_the_commands(self):
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "climbs.csv"
            file.write_text("slip_percent,slope_deg\n30,10\n")
            known = command("vehicle", "rover", "--measured", str(file))
            self.assertEqual(soilbin.vehicle_beside_measured(self.rover(), file)["points"], known["points"])

    def test_a_motor_says_how_fast_it_goes(self):
        rover = self.rover()
        rover.drive_line = soilbin.DriveLine.locked
        curve = [soilbin.TorquePoint(speed=0.0, torque=30.0), soilbin.TorquePoint(speed=5.0, torque=0.0)]
        rover.motor = soilbin.GearedMotor(torque_curve=curve)
        self.assertEqual(soilbin.vehicle_on_soil(rover)["fastest"]["limit"], "torque")
        with self.assertRaisesRegex(soilbin.InputError, "two points or more"):
            soilbin.GearedMotor(torque_curve=curve[:1])
        rover.motor.torque_curve = []
        with self.assertRaisesRegex(soilbin.InputError, "two points or more"):
            soilbin.vehicle_on_soil(rover)

    def test_a_map_is_told_with_its_progress(self):
        rover, shares = self.rover(), []
        answer = soilbin.vehicle_on_soil(rover, map_samples=2, progress=lambda done, stage: shares.append(done))
        chance = answer["map"]["chance"]
        self.assertEqual(chance[0][0]["value"], 1.0)
        self.assertTrue(shares)

    def test_what_makes_no_sense_is_refused(self):
        with self.assertRaisesRegex(soilbin.InputError, "has no tire"):
            soilbin.vehicle_on_soil(soilbin.Vehicle(name="bare", mass=100.0, soil="dry-sand",
                                                    centre_of_gravity=soilbin.VehiclePoint(z=0.5),
                                                    axles=[soilbin.VehicleAxle(x=0.0, track=1.0)]))
        with self.assertRaisesRegex(soilbin.InputError, "vehicle.yaml:2:1"):
            soilbin.parse_vehicle("format: soilbin-vehicle-case/1\nweight: 3 t\n")
        with self.assertRaisesRegex(TypeError, "expected a Vehicle"):
            soilbin.drive_vehicle("truck.yaml")

    def test_the_guides_python_runs(self):
        page = (Path(__file__).parents[2] / "docs/guide/vehicle.md").read_text()
        blocks = re.findall(r"```python\n(.*?)```", page, re.DOTALL)
        self.assertTrue(blocks)
        with contextlib.chdir(Path(__file__).parents[2]):
            for block in blocks:
                exec(block, {})  # as a reader would


class Loop(unittest.TestCase):
    def test_it_says_what_the_command_says(self):
        known = command("loop", "made-lesson", "--folds", "2")
        answer = compare.run_loop("made-lesson", folds=2, threads=2)
        self.assertEqual(json.loads(answer.json()), known)
        self.assertEqual(answer.verdict, compare.Verdict.effect_found)
        self.assertEqual(answer.effects[0].choice.id, "multipass")
        self.assertEqual(answer.worse, known["worse"])
        self.assertEqual(answer.presumes, {"multipass": []}, "it reads nothing of a wheel")

    def test_an_effect_tells_what_it_presumes_of_the_wheel(self):
        smooth = soilbin.Tire(radius=0.25, width=0.1)
        height, *_ = bekker_wong.presumed("lug_thrust", smooth)
        self.assertEqual(height.key, "lugs.height")
        self.assertAlmostEqual(height.value, 0.05 * smooth.radius)
        self.assertIn("5 % of the radius", height.words)
        self.assertEqual(bekker_wong.presumed("slip_sinkage", smooth), [])

    def test_a_model_beside_itself_differs_by_nothing(self):
        comparison = compare.compare_case("rover-slip", measured=None)
        frame = compare.differences_frame(comparison)
        self.assertEqual(set(frame.reference), {"bekker_wong"})
        at_zero = frame[(frame.slip == 0) & (frame.channel == "drawbar_pull")]
        self.assertTrue((at_zero.difference == 0).all())  # slip sinkage begins with slip
        self.assertTrue((frame.difference == frame.value - frame.reference_value).all())


if __name__ == "__main__":
    unittest.main(verbosity=2)
