# Completion of `swarmanoid` for bash: the program itself says what may follow.
_swarmanoid()
{
  local IFS=$'\n' line
  COMPREPLY=()
  for line in $("${COMP_WORDS[0]}" --complete "${COMP_WORDS[@]:1:COMP_CWORD}" 2>/dev/null); do
    case $line in
      :files*)
        local ending=${line#:files} file
        for file in $(compgen -f -- "${COMP_WORDS[COMP_CWORD]}"); do
          if [ -d "$file" ]; then COMPREPLY+=("$file/"); else [[ $file = *"${ending# }" ]] && COMPREPLY+=("$file"); fi
        done
        ;;
      *) COMPREPLY+=("${line%%$'\t'*}") ;;
    esac
  done
  # A folder and a setting go on.
  if [ ${#COMPREPLY[@]} -eq 1 ] && [[ ${COMPREPLY[0]} = *[/=] ]]; then compopt -o nospace; fi
}
complete -F _swarmanoid swarmanoid
