#!/bin/sh
# The Python package as a wheel, installed into an environment of its own: it is imported there, finds its cases beside it
# and answers. wheel.sh SOURCE SCRATCH
set -eu
unset SOILBIN_CASES PYTHONPATH
export PYTHONDONTWRITEBYTECODE=1 PIP_DISABLE_PIP_VERSION_CHECK=1
rm -rf "$2"
/usr/bin/python3 -m venv --system-site-packages "$2/environment"  # numpy, pandas and setuptools are Debian's
pip=$2/environment/bin/pip
"$pip" wheel --quiet --no-index --no-build-isolation --no-deps --wheel-dir "$2" "$1"
"$pip" install --quiet --no-index "$2"/soilbin-*.whl
cd "$2"
environment/bin/python - <<'PY'
from pathlib import Path
import soilbin

environment = Path("environment").resolve()
assert Path(soilbin.__file__).is_relative_to(environment), soilbin.__file__
assert Path(soilbin.cases_folders()[0]) == environment / "share/soilbin/cases", soilbin.cases_folders()
answer = soilbin.estimate(soilbin.Scenario("rover-wheel", "dry-sand"), load=80, slip=0.2)
assert answer.drawbar_pull.std_error > 0
print(soilbin.__version__, answer.drawbar_pull)
PY
