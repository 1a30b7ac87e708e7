"""Command: make a set of campaigns, more runs of one, or run the self-test (from bench/loop: python3 -m nature --help)."""
import argparse
import json
import sys
import time


def main(argv=None):
    """Exit status 0, 1 where the self-test fails, 2 for bad arguments."""
    from . import campaign, selftest, sets
    parser = argparse.ArgumentParser(prog="nature", description="Synthetic single-wheel campaigns, independent of soilbin.")
    parser.add_argument("--set", choices=("tune", "report", "check"), default="tune",
                        help="seed stream; report is never looked at while tuning")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--count", type=int, default=20)
    parser.add_argument("--only", choices=sets.ALONE, help="one kind alone")
    parser.add_argument("--rows", type=int, help="runs of each campaign, in place of what its plan draws")
    parser.add_argument("--out", help="folder for c001.., truth.json and the hidden .nature/")
    parser.add_argument("--more", metavar="CAMPAIGN", help="append runs to this campaign")
    parser.add_argument("--condition", default="{}", help='JSON, e.g. {"slip": 0.5, "load_N": 400}')
    parser.add_argument("--runs", type=int, default=3)
    parser.add_argument("--self-test", action="store_true")
    args = parser.parse_args(argv)
    if args.self_test:
        return selftest.run()
    if args.more:
        try:
            print(f"{len(campaign.more(args.more, json.loads(args.condition), args.runs))} runs appended to {args.more}")
        except (ValueError, OSError) as error:
            print(f"nature: {error}", file=sys.stderr)
            return 2
        return 0
    if not args.out:
        parser.error("--out is needed")
    start = time.time()
    truth = sets.generate(args.set, args.seed, args.count, args.out, args.only, say=lambda text: print(text, file=sys.stderr), runs=args.rows)
    print(f"{len(truth)} campaigns in {time.time() - start:.1f} s")
    return 0


if __name__ == "__main__":
    sys.exit(main())
