#!/usr/bin/env bash
# Feeds broken files to every reader (tests/fuzz). Usage: ./test --fuzz SECONDS [TARGET...]
# The seconds are divided among the targets. Exits with code 1 at the first finding, and prints the folder of its input.
# Inputs that reach new code are kept in build/fuzz/corpus, from which the next run starts.
set -euo pipefail
root=$(cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/.." && pwd)
source "$root/tools/setup.sh"
cd "$root"

seconds=${1:-}
[[ $seconds =~ ^[1-9][0-9]*$ ]] || fail "--fuzz needs a number of seconds, as in ./test --fuzz 60"
shift
ensurePackages build test fuzz
buildPreset fuzz fuzz

# Dictionary of inputs: the words of tables and the string literals of sources, plain and as JSON strings.
words() {
    local table=$1
    shift
    { grep -ohE '[A-Za-z0-9_]{2,40}' "$table" || true; grep -ohE '"[A-Za-z0-9_.:/-]{1,40}"' "$@" | tr -d '"'
        printf '%s\n' -1 1e39 1e308 2147483648 4294967296 9007199254740992 18446744073709551615 null true false; } |
        sort -u | sed 's/.*/"&"\n"\\"&\\""/'
}
dictionaryOf() {
    case $1 in
    gltf | glb | posed) words scenes/import/GltfSchema.cpp scenes/import/Gltf*.cpp ;;
    mtl) words /dev/null scenes/import/Mtl* scenes/import/ObjMaterials.cpp ;;
    scene) words scenes/schema/scene.schema.json scenes/import/SceneJson* engine/*.cpp renderer/frame/FrameSettings.cpp ;;
    bench | matrix) words /dev/null validation/bench/*.cpp engine/*.cpp renderer/frame/FrameSettings.cpp ;;
    settings) words /dev/null viewer/session/Preferences.cpp engine/*.cpp renderer/frame/FrameSettings.cpp ;;
    *) cat "$root/tests/fuzz/dictionaries/$1.txt" 2>/dev/null || true ;;
    esac
}

targets=("$@")
if [ ${#targets[@]} -eq 0 ]; then
    mapfile -t targets < <(sed -n 's/^TARGET(\([a-z0-9_]*\),.*/\1/p' "$root/tests/fuzz/Targets.inc")
fi
each=$(((seconds + ${#targets[@]} - 1) / ${#targets[@]}))
for target in "${targets[@]}"; do
    program=$root/build/fuzz/tests/fuzz/fuzz_$target
    [ -x "$program" ] || fail "There is no target '$target' in tests/fuzz/Targets.inc."
    kept=$root/build/fuzz/corpus/$target findings=$root/build/fuzz/findings/$target log=$root/build/fuzz/$target.log
    mkdir -p "$kept" "$findings"
    options=("-artifact_prefix=$findings/" -max_total_time="$each" -rss_limit_mb=2048 -timeout=10 -max_len=65536)
    dictionary=$root/build/fuzz/$target.dict
    dictionaryOf "$target" >"$dictionary"
    [ ! -s "$dictionary" ] || options+=("-dict=$dictionary")
    # An allocation that is too large is a finding, not a null pointer.
    if ! ASAN_OPTIONS=allocator_may_return_null=0:detect_leaks=1 UBSAN_OPTIONS=print_stacktrace=1 \
        "$program" "${options[@]}" "$kept" "$root/tests/fuzz/corpus/$target" >"$log" 2>&1 </dev/null; then
        grep -E 'ERROR|SUMMARY|runtime error|what\(\)' "$log" >&2 || true
        fail "fuzz $target: a finding. What was said is in $log, the input in $findings."
    fi
    echo "fuzz $target: $(grep -oE '^Done [0-9]+ runs' "$log" | grep -oE '[0-9]+') runs, no finding"
done
