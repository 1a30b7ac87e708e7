  merge)
    "$soilbin" record merge "$folder/record.json" "$folder"/shards/*.json@known@
    "$soilbin" sweep status "$folder"
    ;;
