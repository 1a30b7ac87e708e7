"""The architecture test: the house keeps its rules (design.md), and each rule catches what it is there for.

Usage: architecture_test.py PROJECT_ROOT
"""
import sys
import tempfile
import unittest
from pathlib import Path

import rules

ROOT = Path(sys.argv.pop(1)).resolve()


class TheHouse(unittest.TestCase):
    def test_keeps_its_rules(self):
        files = rules.project_files(ROOT)
        self.assertGreater(len(files), 50)
        for rule, breaches in rules.RULES.items():
            with self.subTest(rule=rule):
                found = list(breaches(ROOT, files))
                if found:
                    self.fail("\n" + "\n".join(found))

    def test_has_every_floor_that_the_rules_name_or_none_of_its_files(self):
        with_sources = {name.parts[0] for name in rules.project_files(ROOT) if name.suffix in rules.CPP}
        self.assertLessEqual(with_sources, set(rules.FLOORS))

    def test_finds_the_headers_that_people_include(self):
        named = rules.interfaces(ROOT)
        self.assertGreater(len(named), 40)
        self.assertEqual(len(named), len(set(named)), "a header twice")
        self.assertIn("compare/loop/loop.hpp", named)

    def test_has_every_single_file_that_a_rule_excepts(self):
        for places in [*rules.LIBRARIES.values(), rules.TOLD_ELSEWHERE]:
            for place in places:
                if not place.endswith("/"):
                    self.assertTrue((ROOT / place).is_file(), place)


class TheRules(unittest.TestCase):
    def breaches(self, rule, **contents):
        """Breaches of one rule in a tree of files: path with '__' for '/' and '_dot_' for '.', and their text."""
        with tempfile.TemporaryDirectory() as folder:
            root = Path(folder)
            files = []
            for key, text in contents.items():
                name = Path(key.replace("__", "/").replace("_dot_", "."))
                (root / name).parent.mkdir(parents=True, exist_ok=True)
                (root / name).write_text(text, encoding="utf-8")
                files.append(name)
            return list(rules.RULES[rule](root, files))

    def test_a_floor_that_looks_up(self):
        self.assertEqual(self.breaches("floors", scenario__a_dot_hpp='#include <cmath>\n#include "bekker_wong/model.hpp"\n'),
                         ['scenario/a.hpp:2: scenario may not include "bekker_wong/model.hpp"'])

    def test_neighbours_that_meet(self):
        self.assertEqual(len(self.breaches("floors", dem__a_dot_cpp='#include "bekker_wong/gsl.hpp"\n')), 1)
        self.assertEqual(len(self.breaches("floors", bekker_wong__a_dot_cpp='#  include "dem/engine/grains.hpp"\n')), 1)

    def test_a_floor_that_looks_down(self):
        self.assertEqual(self.breaches("floors", compare__a_dot_cpp='#include "bekker_wong/model.hpp"\n'), [])

    def test_an_include_not_from_the_root(self):
        self.assertEqual(len(self.breaches("floors", cli__a_dot_cpp='#include "../scenario/tire.hpp"\n')), 1)
        self.assertEqual(len(self.breaches("floors", cli__a_dot_cpp='#include "print.hpp"\n')), 1)

    def test_an_include_of_its_own_in_brackets_or_in_a_file_of_another_ending(self):
        self.assertEqual(self.breaches("floors", cli__a_dot_cpp="#include <scenario/tire.hpp>\n"),
                         ["cli/a.cpp:1: <scenario/tire.hpp> is the project's own: in quotes"])
        self.assertEqual(self.breaches("floors", cli__a_dot_cpp="#include <CLI/CLI.hpp>\n#include <compare>\n"), [])
        for ending in ("inl", "hh", "tpp"):
            self.assertEqual(len(self.breaches("floors", **{f"scenario__a_dot_{ending}": '#include "cli/outputs.hpp"\n'})), 1)

    def test_a_floor_of_its_own(self):
        self.assertEqual(len(self.breaches("floors", engine__a_dot_cpp='#include "scenario/tire.hpp"\n')), 1)

    def test_a_library_out_of_its_room(self):
        self.assertEqual(len(self.breaches("libraries", bekker_wong__model_dot_cpp="#include <gsl/gsl_math.h>\n")), 1)
        self.assertEqual(self.breaches("libraries", bekker_wong__gsl_dot_cpp="#include <gsl/gsl_math.h>\n"), [])
        self.assertEqual(len(self.breaches("libraries", scenario__a_dot_cpp="#include <CLI/CLI.hpp>\n")), 1)

    def test_a_vague_folder(self):
        self.assertEqual(len(self.breaches("folder names", scenario__utils__a_dot_hpp="")), 1)
        self.assertEqual(self.breaches("folder names", scenario__units_dot_hpp=""), [])

    def test_folders_that_include_each_other(self):
        one = {"dem__engine__a_dot_hpp": '#include "dem/bed/b.hpp"\n', "dem__bed__b_dot_hpp": "// no include\n"}
        self.assertEqual(self.breaches("circles", **one), [])
        self.assertEqual(
            self.breaches("circles", **one, dem__bed__c_dot_cpp='#include "dem/engine/a.hpp"\n'),
            ["dem/bed -> dem/engine -> dem/bed: a circle of folders "
             "(dem/bed/c.cpp -> dem/engine/a.hpp, dem/engine/a.hpp -> dem/bed/b.hpp)"])

    def test_a_circle_over_a_third_folder(self):
        found = self.breaches("circles", compare__a__a_dot_hpp='#include "compare/b/b.hpp"\n',
                              compare__b__b_dot_hpp='#include "compare/c/c.hpp"\n',
                              compare__c__c_dot_hpp='#include "compare/a/a.hpp"\n')
        self.assertEqual(len(found), 1)
        self.assertTrue(found[0].startswith("compare/a -> compare/b -> compare/c -> compare/a: "), found)

    def test_the_folders_of_compare_in_another_order_than_the_page_of_the_house(self):
        def found(first, second):
            return self.breaches("order of compare", compare__a__a_dot_hpp='#include "compare/b/b.hpp"\n',
                                 compare__b__b_dot_hpp="", design_dot_md="Below compare/, in order:\n\n"
                                 f"| folder | what |\n|---|---|\n| {first}/ | x |\n| {second}/ | y |\n\nend\n")
        self.assertEqual(found("b", "a"), [])
        self.assertEqual(found("a", "b"), ["design.md: compare/b/ stands below compare/a/, which includes it "
                                           "(compare/a/a.hpp -> compare/b/b.hpp)"])
        self.assertEqual(len(found("b", "gone")), 2)

    def test_a_header_that_opens_without_a_word(self):
        says = "// The soil as a case declares it: numbers with their sources.\n#pragma once\n"
        self.assertEqual(self.breaches("opening comments", scenario__a_dot_hpp=says), [])
        self.assertEqual(len(self.breaches("opening comments", scenario__a_dot_hpp="#pragma once\n// too late, too late, too late\n")), 1)
        self.assertEqual(len(self.breaches("opening comments", scenario__a_dot_hpp="// The soil.\n#pragma once\n")), 1)

    def api_breaches(self, opening, table="| draw | `compare/plot.hpp` |\n", before=""):
        """Of a tree of one header, and a page that tells people what to include."""
        page = f"# C++\n{before}\n## What to include\n\n| to | headers |\n|---|---|\n{table}\nend\n"
        files = {"compare__plot_dot_hpp": opening, "docs__reference__cpp-api_dot_md": page}
        return self.breaches("opening comments", **files)

    def test_a_header_that_people_include_without_an_example(self):
        says = "// Plots as drawings: axes with units, a legend, error bands.\n"
        self.assertEqual(self.api_breaches(says), ["compare/plot.hpp: docs/reference/cpp-api.md names it: "
                                                   "its opening comment shows an example of a call"])
        self.assertEqual(self.api_breaches(says + "//\n//   svg(sheet);\n"), [])
        self.assertEqual(self.api_breaches(says + "//\n//   const Axis x{.title = \"slip\"}\n"), [])
        table, at_the_margin, below = "//\n//   line      a curve\n", "//\n// svg(sheet);\n", "\n//   svg(sheet);\n"
        for no_example in (table, at_the_margin, below):
            self.assertEqual(len(self.api_breaches(says + no_example)), 1, no_example)

    def test_a_header_that_people_do_not_include_needs_no_example(self):
        says = "// Plots as drawings: axes with units, a legend, error bands.\n"
        self.assertEqual(self.breaches("opening comments", compare__plot_dot_hpp=says), [])
        self.assertEqual(self.api_breaches(says, table="", before="The drawings are made by `compare/plot.hpp`.\n"), [])

    def test_a_header_that_the_page_names_and_that_is_not_there(self):
        found = self.api_breaches("// Plots as drawings: axes with units.\n//\n//   svg(sheet);\n",
                                  "| draw | `compare/plot.hpp`, `compare/gone.hpp` |\n")
        self.assertEqual(found, ["docs/reference/cpp-api.md: names compare/gone.hpp, which is not there"])

    def test_a_machine_path(self):
        path = "/" + "tmp" + "/x"
        self.assertEqual(len(self.breaches("machine paths", docs__a_dot_md=f"see {path}\n")), 1)
        self.assertEqual(self.breaches("machine paths", docs__a_dot_md="see build" + path + "\n"), [])

    def test_an_effect_that_names_another(self):
        one = "std::vector<EffectForm> drift_forms() { return {}; }\n"
        other = 'std::vector<EffectForm> moisture_forms() { return find("drift"); }  // unlike drift\n'
        self.assertEqual(self.breaches("effects", bekker_wong__effects__drift_dot_cpp=one,
                                       bekker_wong__effects__moisture_dot_cpp=other),
                         ["bekker_wong/effects/moisture.cpp:1: effect moisture names effect drift"])

    def test_a_sentence_that_is_formatted_where_things_are_computed(self):
        def found(statement, name="compare__fit__a_dot_cpp"):
            return self.breaches("sentences", **{name: f"std::string said() {{\n  {statement}\n}}\n"})
        said = 'return fmt::format("The fit leaves {} of the squared "\n    "residual unexplained.", share);'
        self.assertEqual(found(said), ["compare/fit/a.cpp: formats the sentence 'The fit leaves {} of the squared residual "
                                       "unexplained.': sentences are made in compare/telling/"])
        self.assertEqual(found(said, "compare__telling__a_dot_cpp"), [])
        self.assertEqual(found(said.replace("return", "throw InputError(").replace(";", ");")), [])
        self.assertEqual(found('return fmt::format("{} of {}", done, all);  // The share of all that is done.'), [])

    def test_a_number_that_is_read_by_the_locale(self):
        reads = "double x = std::stod(text);  // 18.4\n"
        self.assertEqual(self.breaches("locale", scenario__a_dot_cpp=reads),
                         ["scenario/a.cpp:1: stod(...) reads by the locale: read_number of scenario/quantity.hpp"])
        self.assertEqual(self.breaches("locale", tests__a_dot_cpp=reads), [])
        self.assertEqual(self.breaches("locale", cli__a_dot_cpp="int n = std::stoi(text);  // not strtod(text)\n"), [])


if __name__ == "__main__":
    unittest.main()
