"""A notebook runs from a clean kernel, every assertion in it holds, and it is stored without outputs.

notebook_test.py FILE.ipynb SCRATCH
"""
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
warnings = [out["text"] for out in outputs if out.get("name") == "stderr"]
assert not warnings, f"a student would see: {warnings}"
figures = sum("image/png" in out.get("data", {}) for out in outputs)
assert figures >= 2, "a lesson shows what it says"
print(f"{notebook.name}: {len(code)} cells, {figures} figures")
