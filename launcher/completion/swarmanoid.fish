# Completion of `swarmanoid` for fish: the program itself says what may follow.
function __swarmanoid_complete
    set -l words (commandline -opc) (commandline -ct)
    for line in ($words[1] --complete $words[2..-1] 2>/dev/null)
        switch $line
            case ':files*'
                set -l ending (string replace -r '^:files ?' '' -- $line)
                __fish_complete_path (commandline -ct) | string match -r ".*(?:/|$ending)(?:\t.*)?\$"
            case '*'
                echo $line
        end
    end
end
complete -c swarmanoid -f -a '(__swarmanoid_complete)'
