#!/usr/bin/env bash
# Tests of the pages for readers: every relative link leads somewhere, every command that they name exists, and
# the version is the same everywhere.
set -uo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.." || exit 1

failures=0
wrong() {
    echo "FAILED $*"
    failures=$((failures + 1))
}

# anchors PAGE: the names of its headings as GitHub makes them: lower case, without punctuation, blanks as hyphens.
anchors() {
    awk '/^```/ { code = !code } !code && /^#+ /' "$1" | sed -E 's/^#+ //; s/\[([^]]*)\]\([^)]*\)/\1/g' |
        tr '[:upper:]' '[:lower:]' | sed -E 's/[^[:alnum:] _-]//g; s/ /-/g'
}

links=0
check_links() { # PAGE
    local link target anchor
    while IFS= read -r link; do
        links=$((links + 1))
        target=${link%%#*}
        anchor=
        [[ $link != *"#"* ]] || anchor=${link#*#}
        if [ -n "$target" ]; then target=$(dirname "$1")/$target; else target=$1; fi
        [ -e "$target" ] || wrong "$1: ($link) is not there"
        if [ -n "$anchor" ] && [ -f "$target" ]; then
            anchors "$target" | grep -qxF -- "$anchor" || wrong "$1: ($link): no such heading"
        fi
    done < <(sed -E 's/`[^`]*`//g' "$1" | grep -oE '\]\([^) ]+\)' | sed 's/^](//; s/)$//' | grep -vE '^[a-z]+:')
}

check_commands() { # PAGE
    local command
    while IFS= read -r command; do
        case $command in test | setup | package) continue ;; esac
        [ -d "apps/$command" ] || wrong "$1: there is no command ./run $command"
    done < <(grep -oE '\./run [a-z]+' "$1" | cut -d ' ' -f 2 | sort -u)
}

for page in ./*.md docs/*.md; do
    check_links "$page"
    check_commands "$page"
done
[ "$links" -gt 50 ] || wrong "only $links links were found: this test does not look at them"

version=$(sed -n 's/^project(cicatrix VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
metainfo=cmake/packaging/localhost.cicatrix.cicatrix.metainfo.xml
for place in "CITATION.cff:^version: $version\$" "CHANGELOG.md:^## $version\$" "cmake/packaging/changelog:^cicatrix ($version) " \
    "$metainfo:<release version=\"$version\""; do
    grep -q "${place#*:}" "${place%%:*}" || wrong "${place%%:*} does not name version $version"
done
date=$(sed -n 's/^date-released: //p' CITATION.cff)
grep -q "version=\"$version\" date=\"$date\"" "$metainfo" || wrong "$metainfo and CITATION.cff differ in the date"

pictures=$(du -cb docs/images/tutorial/* | tail -n 1 | cut -f 1)
[ "$pictures" -lt 600000 ] || wrong "the tutorial's pictures have $pictures bytes"

echo "$links links, $failures failures"
[ "$failures" = 0 ]
