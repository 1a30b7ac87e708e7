# bash completion for soilbin; made by: soilbin manual --bash-completion
_soilbin() {
  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} flags=""
  COMPREPLY=()
  if [ "$COMP_CWORD" -eq 1 ]; then
    COMPREPLY=($(compgen -W "@commands@" -- "$word"))
    return
  fi
  case "$before" in
    --tire | --soil)
      COMPREPLY=($(compgen -W "$(soilbin list "${before#--}s" 2>/dev/null | awk 'NR > 1 {print $1}')" -- "$word"))
      return
      ;;
  esac
  case "${COMP_WORDS[1]}" in
@cases@  esac
  [[ "$word" == -* ]] && COMPREPLY=($(compgen -W "$flags" -- "$word"))
}
complete -o default -F _soilbin soilbin
