# Completion of porosph for bash: source <(porosph completion bash)
_porosph_words() {  # candidates that begin with the word at the cursor, which may hold = and :
  local cut=${word%"${word##*[:=]}"} candidate
  for candidate in $1; do
    [[ $candidate == "$word"* ]] && COMPREPLY+=("${candidate#"$cut"}")
  done
  if [[ ${#COMPREPLY[@]} -eq 1 && ${COMPREPLY[0]} == *= ]]; then compopt -o nospace; fi
}
_porosph_paths() {
  compopt -o filenames 2> /dev/null
  mapfile -t COMPREPLY < <(compgen "$1" -- "${word##*=}")
}
_porosph_cases() {  # cases and folders here, and the shipped cases, whose folders are stepped into too
  compopt -o filenames 2> /dev/null
  mapfile -t COMPREPLY < <(compgen -f -X '!*.toml' -- "$word"; compgen -d -- "$word")
  local name rest last=
  for name in $(porosph list --names 2> /dev/null); do
    [[ $name == "$word"* ]] || continue
    rest=${name#"$word"}
    if [[ $rest == */* ]]; then
      name=$word${rest%%/*}/
      compopt -o nospace
    fi
    [[ $name == "$last" ]] || COMPREPLY+=("$name")
    last=$name
  done
}
_porosph() {
  local words line=${COMP_LINE:0:COMP_POINT}
  read -ra words <<< "$line"
  [[ $line == *[[:space:]] ]] && words+=("")
  local word=${words[-1]} previous=${words[-2]}
  COMPREPLY=()
  if [[ ${#words[@]} -eq 2 ]]; then
    _porosph_words '@commands@ --help --version'
    return
  fi
  if [[ $word == --*=* ]]; then
    previous=${word%%=*}
    word=${word#*=}
  fi
  case ${words[1]} in
@subcommands@  esac
}
complete -F _porosph porosph
