"""What the benches against other engines print of their runs, from standard input.

figures.py lammps CORES STEPS           a LAMMPS log -> one line: engine threads=.. particle_steps_per_second=.. FIELD=..
figures.py liggghts CORES STEPS FORCES  a LIGGGHTS log and its file of forces -> such a line; an error is the standard error
                                        of the mean over ten blocks of time
figures.py soilbin CORES STEPS          what peer_wheel prints -> such a line
figures.py ratios PEER FIELD... [SHARE] such lines of soilbin and a peer -> medians, how far the fields are apart (more
                                        than SHARE: exit status 1), and the ratios
"""
import re
import statistics
import sys

grains_of_bed = 57000  # as in shared_bed.hpp


def rate_of(log, steps):
    """Grain-steps a second of the log's last run of so many steps."""
    seconds, atoms = [m.groups() for m in re.finditer(
        rf"Loop time of (\S+) on \d+ procs for {steps} steps with (\d+) atoms", log)][-1]
    return int(atoms) * steps / float(seconds)


def line(engine, cores, rate, **fields):
    print(f"{engine} threads={cores} particle_steps_per_second={rate:.5g}",
          *(f"{name}={value:.6g}" for name, value in fields.items()))


def lammps(cores, steps, log):
    force, coordination = re.findall(r"^\s*\d+\s+(\S+)\s+(\S+)\s*$", log, re.M)[-1]
    line("lammps", cores, rate_of(log, steps), mean_force=float(force), coordination=float(coordination))


def of_wheel(engine, cores, rate, rows):
    """The line of a run with the wheel, from rows of step, push, lift and torque."""
    samples = [[float(word) for word in row.split()] for row in rows if not row.startswith("#")]
    fields = {}
    for name, sign, column in zip(("push", "lift", "torque"), (1, 1, -1), list(zip(*samples))[1:]):
        blocks = [statistics.mean(column[len(column) * k // 10:len(column) * (k + 1) // 10]) for k in range(10)]
        fields |= {name: sign * statistics.mean(column), name + "_error": statistics.stdev(blocks) / 10**0.5}
    line(engine, cores, rate, **fields)


def liggghts(cores, steps, forces, log):
    with open(forces, encoding="utf-8") as file:
        rows = [row for row in file if not row.startswith("#")]
    of_wheel("liggghts", cores, rate_of(log, steps), rows[1:])  # the first is of the step before


def soilbin(cores, steps, text):
    seconds = re.search(r"^# seconds (\S+)$", text, re.M)
    if not seconds:
        sys.exit("peer_wheel ended without an answer")
    of_wheel("soilbin", cores, grains_of_bed * steps / float(seconds[1]), text.splitlines())


def ratios(peer, fields, allowed, text):
    runs = {}
    for row in text.splitlines():
        engine, *pairs = row.split()
        values = {key: float(value) for key, value in (pair.split("=") for pair in pairs)}
        runs.setdefault((engine, int(values["threads"])), []).append(values)
    median = {key: {name: statistics.median(run[name] for run in of) for name in of[0]} for key, of in runs.items()}
    print(f"{'engine':10}{'cores':>6}{'grain-steps/s, median':>24}{'least .. most':>24}",
          *(f"{name:>13}" for name in fields), sep="")
    for (engine, cores), of in sorted(runs.items()):
        rates = [run["particle_steps_per_second"] for run in of]
        values = median[engine, cores]
        print(f"{engine:10}{cores:>6}{values['particle_steps_per_second']:>24.4g}{min(rates):>13.3g} ..{max(rates):>8.3g}",
              *(f"{values[name]:>13.4g}" for name in fields), sep="")
    apart = max(abs(median["soilbin", cores][name] / median[peer, cores][name] - 1)
                for cores in (1, 2) for name in fields)
    verdict = "" if allowed is None else "; as demanded" if apart <= allowed else f"; NOT to {100 * allowed:g} %"
    print(f"{' and '.join(fields)} are at most {100 * apart:.2g} % apart{verdict}")
    two = median["soilbin", 2]["particle_steps_per_second"] / median["soilbin", 1]["particle_steps_per_second"]
    print(f"two cores are {two:.3g} times one")
    for one in sorted({engine for engine, _ in runs} - {"soilbin", peer}) + [peer]:  # the peer's come last
        print(*(f"{one}_ratio_{cores}=" + format(median["soilbin", cores]["particle_steps_per_second"]
                                                 / median[one, cores]["particle_steps_per_second"], ".3g")
                for cores in (1, 2)))
    return allowed is None or apart <= allowed


def main(words):
    if words[:1] == ["lammps"] and len(words) == 3:
        return lammps(int(words[1]), int(words[2]), sys.stdin.read())
    if words[:1] == ["liggghts"] and len(words) == 4:
        return liggghts(int(words[1]), int(words[2]), words[3], sys.stdin.read())
    if words[:1] == ["soilbin"] and len(words) == 3:
        return soilbin(int(words[1]), int(words[2]), sys.stdin.read())
    if words[:1] == ["ratios"] and len(words) > 2:
        allowed = float(words[-1]) if words[-1][0].isdigit() else None
        fields = words[2:] if allowed is None else words[2:-1]
        return 0 if ratios(words[1], fields, allowed, sys.stdin.read()) else 1
    return __doc__


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
