# A job that is stopped before its time limit ends with 3 and goes to the queue again.
again() {
  srun --cpus-per-task=@threads@ "$@"
  status=$?
  [ $status -ne 3 ] || scontrol requeue "$SLURM_JOB_ID"
  exit $status
}

case "${1-submit}" in
  bed) again "$soilbin" bed "${bed[@]}" --shard "$SLURM_ARRAY_TASK_ID/@beds@" ;;
  run)
    part=$SLURM_ARRAY_TASK_ID
    again "$soilbin" run "${run[@]}" --shard "$part/@shards@" --record "$folder/shards/$part-of-@shards@.json"
    ;;
@merge@  submit)
    command -v sbatch >/dev/null || {
      echo "Slurm is not on this machine: there is no sbatch. Start this script on a machine of the cluster; on this" \
        "machine alone: soilbin sweep --on local" >&2
      exit 1
    }
    job() {
      sbatch --parsable --requeue --signal=TERM@60 --open-mode=append --ntasks=1 --cpus-per-task=@threads@ --mem=@memory@M "$@"
    }
    beds=$(job --job-name=@name@-beds --array=1-@beds@ --time=@bed_minutes@ --output="$folder/logs/bed-%a.log" \
      "$folder/sweep.sh" bed) &&
      runs=$(job --job-name=@name@-runs --array=1-@shards@ --time=@run_minutes@ --output="$folder/logs/run-%a.log" \
        --dependency="afterany:$beds" "$folder/sweep.sh" run) &&
      merge=$(job --job-name=@name@-merge --time=10 --output="$folder/logs/merge.log" \
        --dependency="afterany:$runs" "$folder/sweep.sh" merge) || exit
    echo "$beds $runs $merge" >"$folder/jobs"
    echo "submitted: beds $beds, runs $runs, merge $merge"
    ;;
esac
