# The job KIND for each of 1 .. COUNT, @at_once@ at once.
each() { seq "$2" | xargs -P @at_once@ -n 1 bash "$folder/sweep.sh" "$1"; }

case "${1-all}" in
  bed) exec "$soilbin" bed "${bed[@]}" --shard "$2/@beds@" >>"$folder/logs/bed-$2.log" 2>&1 ;;
  run)
    echo $$ >"$folder/running/$2"  # this process, which soilbin becomes
    exec "$soilbin" run "${run[@]}" --shard "$2/@shards@" --record "$folder/shards/$2-of-@shards@.json" \
      >>"$folder/logs/run-$2.log" 2>&1
    ;;
@merge@  all)
    each bed @beds@
    each run @shards@
    bash "$folder/sweep.sh" merge
    ;;
esac
