"""What flipped bits, edits, depth and size of a file do to the command that reads it."""
import json
import random
import unittest

from attack import SMALL_MAP, Attack, limited


class DamagedFiles(Attack):
    def record(self):
        self.expect(0, [], *self.grains("--record", "record.json"))
        return self.here / "record.json"

    def test_no_flipped_bit_of_a_record_changes_an_answer(self):
        file = self.record()
        text = file.read_bytes()
        right = json.loads(self.expect(0, [], "run", self.case, "--json", "--recorded", file)[0])["rows"]
        draw = random.Random(26)
        refused = 0
        for _ in range(200):
            damaged = bytearray(text)
            damaged[draw.randrange(len(text))] ^= 1 << draw.randrange(8)
            (self.here / "damaged.json").write_bytes(damaged)
            status, out, err = self.soilbin("run", self.case, "--json", "--recorded", "damaged.json")
            self.assertIn(status, (0, 2), err)
            if status == 0:
                self.assertEqual(json.loads(out)["rows"], right)
            else:
                self.assertIn("damaged.json", err + out)
                refused += 1
        self.assertGreater(refused, 150)

    def test_an_answer_that_was_edited_is_refused(self):
        file = self.record()
        document = json.loads(file.read_text())
        document["runs"][0]["drawbar_pull"] += 1.0
        file.write_text(json.dumps(document))
        self.expect(2, ["record.json: runs[0]", "its seal doesn't fit", "hint"], "run", self.case, "--recorded", file)
        del document["runs"][0]["seal"]
        file.write_text(json.dumps(document))
        self.expect(2, ["record.json: runs[0]", "its seal is missing"], "run", self.case, "--recorded", file)

    def test_a_record_from_before_there_were_seals_is_read_and_that_is_said(self):
        file = self.record()
        document = json.loads(file.read_text())
        del document["seal"]
        for run in document["runs"]:
            del run["seal"]
        file.write_text(json.dumps(document))
        self.expect(0, "1 of its 1 runs carry no seal", "run", self.case, "--recorded", file)

    def test_depth_and_size_have_bounds_and_errors_name_the_place(self):
        readers = {"record": ["run", "paper-straight", "--recorded"], "store": [*SMALL_MAP, "--stored", "--store"],
                   "replay": ["compare", "paper-straight", "--no-loop", "--replay"],
                   "campaign of a record": ["campaign", "--output", "told"]}
        bounded = limited(AS=3 << 30)
        for reader, words in readers.items():
            with self.subTest(reader=reader):
                (self.here / "deep").write_text('{"format": ' + "[" * 100000 + "\n")
                self.expect(2, ["deep:1:", "nested deeper than 32 levels"], *words, "deep")
                (self.here / "large").write_text('{"format": 1e309}\n')
                self.expect(2, ["large:1:12", "this number is too large"], *words, "large")
                self.expect(2, ["/dev/zero", "is not a regular file"], *words, "/dev/zero", within=20, preexec_fn=bounded)
                with open(self.here / "huge", "wb") as huge:
                    huge.truncate(1 << 40)
                self.expect(2, ["huge", "larger than"], *words, "huge", within=60, preexec_fn=bounded)


if __name__ == "__main__":
    unittest.main(verbosity=1)
