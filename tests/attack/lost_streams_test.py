"""Standard streams that are closed, full or gone: the work and its restarts do not hang on them."""
import json
import os
import signal
import subprocess
import time
import unittest

from attack import SOILBIN, Attack, files_in


class LostStreams(Attack):
    def shell(self, line, within=120):
        """The command as a shell starts it: "$SOILBIN" stands for it."""
        return subprocess.run(["bash", "-c", line], cwd=self.here, env=self.environment(SOILBIN=SOILBIN), text=True,
                              capture_output=True, timeout=within, check=False)

    def test_errors_that_nobody_reads_change_no_answer(self):
        right = self.shell('"$SOILBIN" estimate rover-slip --slip 20% --json 2>/dev/null')
        self.assertEqual(right.returncode, 0)
        for where in ("2>/dev/full", "2>&-", "0<&- 2>&-", "2> >(exec 0<&-; sleep 1)"):
            done = self.shell(f'"$SOILBIN" estimate rover-slip --slip 20% --json {where}')
            self.assertEqual((done.returncode, done.stdout), (0, right.stdout), where)
            refused = self.shell(f'"$SOILBIN" estimate no-such-study {where}')
            self.assertEqual(refused.returncode, 2, where)

    def test_an_answer_that_nobody_can_read_is_told(self):
        for where in (">/dev/full", ">&-"):
            for words in ("list soils", "--help", "estimate rover-slip --slip 20%"):
                done = self.shell(f'"$SOILBIN" {words} {where}')
                self.assertEqual(done.returncode, 1, f"{words} {where}")
                self.assertIn("can't be written to standard output", done.stderr)
        self.assertEqual(self.shell('"$SOILBIN" list soils >&- 2>&-').returncode, 1)

    def test_no_file_takes_the_place_of_a_closed_stream(self):
        done = self.shell('"$SOILBIN" run rover-slip --csv out.csv 0<&- 1>&- 2>&-')
        self.assertEqual(done.returncode, 1, "its standard output is lost")
        text = (self.here / "out.csv").read_text()
        self.assertTrue(text.startswith("model,"), text[:200])
        self.assertNotIn("warning", text)

    def test_a_run_of_grains_goes_on_and_keeps_its_restart_where_its_log_is_full(self):
        words = self.grains("--record", "record.json")
        words.remove("--json")
        line = " ".join(f"'{word}'" for word in map(str, words))
        process = subprocess.Popen(["bash", "-c", f'exec "$SOILBIN" {line} >out.txt 2>/dev/full'], cwd=self.here,
                                   env=self.environment(SOILBIN=SOILBIN))
        self.addCleanup(lambda: process.poll() is None and process.kill())
        deadline = time.monotonic() + 60
        while not any("bed" in name for name in files_in(self.beds)) and process.poll() is None:
            self.assertLess(time.monotonic(), deadline)
            time.sleep(0.02)
        time.sleep(0.3)
        process.send_signal(signal.SIGTERM)
        stopped = process.wait(60)
        self.assertIn(stopped, (0, 130), "ended by itself, whatever became of its words")
        done = self.shell(f'"$SOILBIN" {line} 2>&-')
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertEqual(len(json.loads((self.here / "record.json").read_text())["runs"]), 1)

    def test_a_terminal_sees_progress_in_place(self):
        primary, secondary = os.openpty()
        self.addCleanup(os.close, primary)
        process = subprocess.Popen([SOILBIN, *map(str, self.grains())], cwd=self.here, env=self.environment(),
                                   stdout=subprocess.DEVNULL, stderr=secondary)
        os.close(secondary)
        seen = b""
        while b"\r\x1b[K" not in seen:
            seen += os.read(primary, 4096)
        process.kill()
        process.wait()
        self.assertIn(b"dem", seen)


if __name__ == "__main__":
    unittest.main(verbosity=1)
