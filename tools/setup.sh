# Sourced by ./run and ./test: brings the machine's packages and the build up to date, silently if they already are.
# shellcheck shell=bash disable=SC2154 # `root` comes from the caller
# Expects `root`, the repository's root. All output goes to stderr; stdout belongs to the program.

packageTable=$root/tools/packages.txt

fail() {
    printf '%s\n' "$@" >&2
    exit 1
}

# Packages of the given sets of the table, one per line.
packagesOf() {
    awk -v sets=" $* " '!/^#/ && index(sets, " " $2 " ") { print $1 }' "$packageTable"
}

# The packages named on stdin that are not installed.
missingPackages() {
    local wanted
    wanted=$(cat)
    # dpkg-query fails for an unknown package, which is missing too.
    # shellcheck disable=SC2086 # one word a package
    { dpkg-query --show --showformat='${db:Status-Status} ${Package}\n' $wanted 2>/dev/null || true; } |
        awk -v wanted="$wanted" '$1 == "installed" { have[$2] = 1 }
            END { n = split(wanted, names, /[ \n]+/); for (i = 1; i <= n; i++) if (!(names[i] in have)) print names[i] }'
}

# Runs a command silently; prints its output if it fails.
quietly() {
    local log
    log=$(mktemp)
    if ! "$@" >"$log" 2>&1 </dev/null; then
        cat "$log" >&2
        rm -f "$log"
        return 1
    fi
    rm -f "$log"
}

hasApt() {
    command -v apt-get >/dev/null && command -v dpkg-query >/dev/null
}

aptGet() {
    local elevate=()
    [ "$(id -u)" -eq 0 ] || elevate=(sudo)
    "${elevate[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -qq -o Dpkg::Use-Pty=0 -o DPkg::Lock::Timeout=120 "$@"
}

# ensurePackages SETS...: installs missing packages of the table's sets. A stamp file keeps the result, because
# dpkg-query takes longer than a finished build.
ensurePackages() {
    local sets=$* stamp
    stamp=$root/build/.packages-${sets// /-}-$(cksum <"$packageTable" | tr ' ' '-')
    [ ! -e "$stamp" ] || return 0
    if ! hasApt; then
        local tool lacking=()
        for tool in cmake ninja glad; do command -v "$tool" >/dev/null || lacking+=("$tool"); done
        [ ${#lacking[@]} -eq 0 ] || fail "This machine has no apt-get to install what is missing (${lacking[*]}): install CMake 3.25, Ninja," \
            "a C++20 compiler, glad 2 (pip install glad2) and the libraries of vcpkg.json, then run this again (docs/build.md)."
        return 0
    fi
    local missing
    missing=$(packagesOf "$@" | missingPackages | tr '\n' ' ')
    missing=${missing% }
    if [ -n "$missing" ]; then
        echo "Installing Debian packages: $missing" >&2
        # sudo reads the password here, before its output is silenced.
        if [ "$(id -u)" -ne 0 ] && ! { command -v sudo >/dev/null && sudo -v; }; then
            fail "That needs root: apt-get install --no-install-recommends $missing"
        fi
        # Fresh machines have no package lists, old ones may name versions that are gone: then update and try again.
        # shellcheck disable=SC2086 # one word a package
        aptGet install --no-install-recommends --yes $missing >/dev/null 2>&1 </dev/null ||
            { quietly aptGet update && quietly aptGet install --no-install-recommends --yes $missing; } ||
            fail "The packages could not be installed; as root: apt-get install --no-install-recommends $missing"
    fi
    mkdir -p "$root/build"
    : >"$stamp"
}

# Shows ninja's progress from its output on stdin: one changing line on a terminal, one line elsewhere, nothing if
# nothing is built.
showProgress() {
    local line said=
    while IFS= read -r line; do
        case $line in
        # Steps of every build, also of one that has nothing to do.
        *'Re-checking globbed directories'* | *write_commit.cmake*) ;;
        '['*/*']'*)
            if [ -t 2 ]; then
                printf '\rBuilding Tessera %s ' "${line%%]*}]" >&2
            elif [ -z "$said" ]; then
                printf 'Building Tessera (preset %s)\n' "$1" >&2
            fi
            said=yes
            ;;
        esac
    done
    if [ -n "$said" ] && [ -t 2 ]; then printf '\r\033[K' >&2; fi
}

# buildPreset PRESET TARGET...: configures if there is no build yet (ninja handles later changes) and builds.
buildPreset() {
    local preset=$1 dir=$root/build/$1 log=$root/build/$1.log
    shift
    mkdir -p "$dir"
    (
        # Two concurrent builds would corrupt the folder.
        ! command -v flock >/dev/null || flock 9
        if [ ! -e "$dir/build.ninja" ]; then
            echo "Configuring Tessera (preset $preset)" >&2
            local launcher=()
            if command -v ccache >/dev/null; then
                launcher=(-DCMAKE_C_COMPILER_LAUNCHER=ccache -DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
            fi
            if ! (cd "$root" && cmake --preset "$preset" "${launcher[@]}") >"$log" 2>&1 </dev/null; then
                cat "$log" >&2
                rm -f "$root"/build/.packages-* "$dir/build.ninja"
                fail "" "Configuring failed (above). Missing libraries: tools/packages.txt lists Debian's, vcpkg.json other platforms'."
            fi
        fi
        if ! ninja -C "$dir" "$@" 2>&1 </dev/null | tee "$log" | showProgress "$preset"; then
            grep -vE '^\[[0-9]+/[0-9]+\] ' "$log" >&2 || true
            fail "" "The build failed (above)."
        fi
    ) 9>"$root/build/.lock-$preset" || exit 1
}
