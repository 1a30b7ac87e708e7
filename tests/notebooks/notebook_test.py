"""A notebook runs from a clean kernel, every assertion in it holds, and it is stored without outputs. Its exercises don't
hold their solutions and, where nobody has answered yet, don't show them; its figures are those of the documents.

notebook_test.py FILE.ipynb SCRATCH
"""
import base64
import json
import os
import re
import subprocess
import sys
from pathlib import Path

notebook, scratch = Path(sys.argv[1]), Path(sys.argv[2])

known = json.loads(notebook.read_text(encoding="utf-8"))
code = [cell for cell in known["cells"] if cell["cell_type"] == "code"]
stored = [cell["id"] for cell in code if cell["outputs"] or cell["execution_count"] is not None]
assert not stored, f"outputs are stored in cells {stored}; clear them: jupyter-nbconvert --clear-output --inplace"
assert set(known["metadata"]) <= {"kernelspec", "language_info"}, f"metadata of one machine: {known['metadata']}"
assert sum("assert" in "".join(cell["source"]) for cell in code) >= 5, "a lesson asserts what it says"

# an exercise: a cell for the answer and nothing else, then the folded one that knows the right one
exercises = [place for place, cell in enumerate(code) if re.fullmatch(r"answer_\d+ = None  # your number", "".join(cell["source"]))]
assert 5 <= len(exercises) <= 8, f"{len(exercises)} exercises"
for number, place in enumerate(exercises, 1):
    solution = code[place + 1]
    assert "solution" in solution["metadata"].get("tags", []) and solution["metadata"]["jupyter"]["source_hidden"], number
    assert f"check(answer_{number}, right" in "".join(solution["source"]), f"exercise {number} is not checked"
assert sum("answer_" in "".join(cell["source"]) for cell in code) == 2 * len(exercises), "an answer is used elsewhere"

# a figure that a text shows is the documents' own
for cell in known["cells"]:
    for name, kinds in cell.get("attachments", {}).items():
        assert f"(attachment:{name})" in "".join(cell["source"]), f"{name} is attached and not shown"
        if (docs := notebook.resolve().parents[1] / "docs").is_dir():
            [drawn] = docs.rglob(name)
            assert base64.b64decode(kinds["image/svg+xml"]) == drawn.read_bytes(), f"{name} is not {drawn}: notebooks/export --attach"

scratch.mkdir(parents=True, exist_ok=True)
folders = {name: str(scratch / name.lower()) for name in ("JUPYTER_RUNTIME_DIR", "JUPYTER_CONFIG_DIR", "IPYTHONDIR", "MPLCONFIGDIR")}
ran = subprocess.run(["/usr/bin/jupyter-nbconvert", "--to", "notebook", "--execute", "--ExecutePreprocessor.timeout=500",
                      "--output-dir", str(scratch), str(notebook)],
                     env={**os.environ, **folders, "SOILBIN_STILL": "1"}, capture_output=True, text=True)
if ran.returncode != 0:
    print(re.sub(r"\x1b\[[0-9;]*m", "", ran.stderr)[-6000:])
    sys.exit(1)
done = json.loads((scratch / notebook.name).read_text(encoding="utf-8"))
outputs = [out for cell in done["cells"] if cell["cell_type"] == "code" for out in cell["outputs"]]
# what soilbin doubts in an answer is part of the lesson
warnings = [out["text"] for out in outputs if out.get("name") == "stderr" and "SoilbinWarning: " not in "".join(out["text"])]
assert not warnings, f"a student would see: {warnings}"
# as stored every answer is None: a solution's cell says so, and nothing that gives the right one away
for number, place in enumerate(exercises, 1):
    shown = [cell for cell in done["cells"] if cell["cell_type"] == "code"][place + 1]["outputs"]
    texts = "".join("".join(out.get("text", str(out.get("data", "")))) for out in shown if out.get("name") != "stderr")
    assert texts == "No answer yet.\n", f"exercise {number} shows without an answer: {texts!r}"
assert not any("Right" in "".join(out.get("text", "")) for out in outputs), "an answer is called right that nobody gave"
figures = sum("image/png" in out.get("data", {}) for out in outputs)
assert figures >= 2, "a lesson shows what it says"
print(f"{notebook.name}: {len(code)} cells, {figures} figures")
