"""What bench/peers/run prints of its runs, from standard input.

figures.py lammps CORES STEPS   a LAMMPS log -> one line: engine cores=.. particle_steps_per_second=.. mean_force=.. coordination=..
figures.py ratios               such lines -> medians, whether both beds agree, and the ratios
"""
import re
import statistics
import sys

AGREEMENT = 0.02  # of mean contact force and coordination number


def lammps(cores, steps, log):
    loop = [m for m in re.finditer(r"Loop time of (\S+) on \d+ procs for (\d+) steps with (\d+) atoms", log)
            if int(m[2]) == steps][-1]
    force, coordination = re.findall(r"^\s*\d+\s+(\S+)\s+(\S+)\s*$", log, re.M)[-1]
    rate = int(loop[3]) * steps / float(loop[1])
    print(f"lammps threads={cores} particle_steps_per_second={rate:.5g} mean_force={force} coordination={coordination}")


def ratios(text):
    runs = {}
    for line in text.splitlines():
        engine, *pairs = line.split()
        values = {key: float(value) for key, value in (pair.split("=") for pair in pairs)}
        runs.setdefault((engine, int(values["threads"])), []).append(values)
    median = {key: {name: statistics.median(run[name] for run in of) for name in of[0]} for key, of in runs.items()}
    print(f"{'engine':10}{'cores':>6}{'grain-steps/s, median':>24}{'least .. most':>24}{'force [N]':>12}{'coordination':>14}")
    for (engine, cores), of in sorted(runs.items()):
        rates = [run["particle_steps_per_second"] for run in of]
        values = median[engine, cores]
        print(f"{engine:10}{cores:>6}{values['particle_steps_per_second']:>24.4g}{min(rates):>13.3g} ..{max(rates):>8.3g}"
              f"{values['mean_force']:>12.4g}{values['coordination']:>14.4g}")
    apart = max(abs(median["soilbin", cores][name] / median["lammps", cores][name] - 1)
                for cores in (1, 2) for name in ("mean_force", "coordination"))
    print(f"beds agree to {100 * apart:.2g} %; {'as demanded' if apart <= AGREEMENT else 'NOT to 2 %'}")
    two = median["soilbin", 2]["particle_steps_per_second"] / median["soilbin", 1]["particle_steps_per_second"]
    print(f"two cores are {two:.3g} times one")
    of = [median["soilbin", cores]["particle_steps_per_second"] / median["lammps", cores]["particle_steps_per_second"]
          for cores in (1, 2)]
    print(f"lammps_ratio_1={of[0]:.3g} lammps_ratio_2={of[1]:.3g}")
    return apart <= AGREEMENT


if __name__ == "__main__":
    if sys.argv[1:2] == ["lammps"]:
        lammps(int(sys.argv[2]), int(sys.argv[3]), sys.stdin.read())
    elif sys.argv[1:2] == ["ratios"]:
        sys.exit(0 if ratios(sys.stdin.read()) else 1)
    else:
        sys.exit(__doc__)
