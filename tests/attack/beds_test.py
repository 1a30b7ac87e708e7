"""What a second process, a full disk and a stranger's links do to the stores that processes share."""
import json
import shutil
import unittest

from attack import BOARD, Attack, files_in, limited


class TwoProcesses(Attack):
    def test_lose_no_experiment_of_one_store(self):
        both = [self.start(*BOARD, "--store", "two.json", "--seed", seed) for seed in (1, 2)]
        for process in both:
            _, err = process.communicate(timeout=240)
            self.assertIn(process.returncode, (0, 1), err)
        tests = json.loads((self.here / "two.json").read_text())["tests"]
        self.assertEqual(sum(len(test["experiments"]) for test in tests), 18)

    def test_settle_one_bed_side_by_side(self):
        all_of_them = [self.start(*self.grains("--slip", f"{10 + k}%")) for k in range(6)]
        for process in all_of_them:
            _, err = process.communicate(timeout=240)
            self.assertEqual(process.returncode, 0, err)
        self.assertEqual([name[:4] for name in files_in(self.beds)], ["bed-"], files_in(self.beds))


class TheStoreOfBeds(Attack):
    """It is shared, it may be full, and a stranger may have been there."""

    def test_a_full_disk_stops_no_run(self):
        right, _ = self.expect(0, [], *self.grains())
        self.beds = self.folder / "full"
        out, err = self.expect(0, ["warning: ", "File too large", "isn't kept"], *self.grains(),
                               preexec_fn=limited(FSIZE=20000))
        self.assertEqual(json.loads(out)["rows"], json.loads(right)["rows"])
        self.assertIn("goes on without", err)
        self.assertEqual(files_in(self.beds), [])

    def test_a_store_that_is_no_folder_stops_no_run(self):
        self.beds.write_text("in the way")
        self.expect(0, ["warning: ", "the bed isn't kept", "can't be gone on with"], *self.grains())

    def test_a_store_that_may_only_be_read_serves_its_bed(self):
        _, _ = self.expect(0, [], *self.grains())
        mode = self.beds.stat().st_mode
        self.beds.chmod(0o555)
        self.addCleanup(self.beds.chmod, mode)
        self.skip_unless_nobody_can_run()
        _, err = self.expect(0, "can't be gone on with", *self.grains("--slip", "30%"), preexec_fn=self.as_nobody)
        self.assertNotIn("the bed isn't kept", err)

    def test_a_strangers_links_lead_nowhere(self):
        self.expect(1, [], *self.grains("--csv", "/dev/full"))  # leaves the names of bed and run
        bed, run = (next(self.beds.glob(f"{kind}-*.h5")).name for kind in ("bed", "run"))
        shutil.rmtree(self.beds)
        self.beds.mkdir(mode=0o777)
        victim = self.folder / "victim"
        victim.write_text("precious")
        for name in (bed, f"{bed}.writing", f"{bed}.keeping", f"{run}.writing", f"{run}.keeping", f"{run}.lock",
                     f"{run}.stopped"):
            (self.beds / name).symlink_to(victim)
        absent = self.folder / "absent"
        (self.beds / f"{bed}.previous").symlink_to(absent)
        self.expect(0, [], *self.grains())
        self.assertEqual(victim.read_text(), "precious")
        self.assertFalse(absent.exists())
        self.assertFalse((self.beds / bed).is_symlink(), "the bed took the place of the link")


if __name__ == "__main__":
    unittest.main(verbosity=1)
