# Completion of gobo in fish: the program itself tells what may come next, a tab and what it means behind each.
function __gobo_complete
    set -l words (commandline -opc)
    set -l program $words[1]
    set -e words[1]
    set -l current (commandline -ct)
    $program complete $words "$current" 2>/dev/null
end
# Files only where gobo itself offers nothing.
complete -c gobo -f -n 'count (__gobo_complete) >/dev/null' -a '(__gobo_complete)'
