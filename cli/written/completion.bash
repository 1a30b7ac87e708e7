# bash completion for soilbin; made by: soilbin manual --bash-completion

# Offers those of the words behind the first that begin with it, quoted for the line that is typed; expands none.
_soilbin_offer() {
  local word=$1 one
  shift
  for one; do
    [[ "$one" == "$word"* ]] && COMPREPLY+=("$(printf '%q' "$one")")
  done
}

_soilbin() {
  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} flags="" names=()
  COMPREPLY=()
  if [ "$COMP_CWORD" -eq 1 ]; then
    _soilbin_offer "$word" @commands@
    return
  fi
  case "$before" in
    --tire | --soil | vehicle)
      mapfile -t names < <(soilbin list "${before#--}s" --names 2>/dev/null)
      _soilbin_offer "$word" "${names[@]}"
      return
      ;;
  esac
  case "${COMP_WORDS[1]}" in
@cases@  esac
  [[ "$word" == -* ]] && _soilbin_offer "$word" $flags
}
complete -o default -F _soilbin soilbin
