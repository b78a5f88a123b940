# shellcheck shell=bash disable=SC2016,SC2034
# A false machine for the tests of the script `run`, which source this file: a checkout with false programs for
# everything that would install, build or need root rights, and what a test says of the outcome.

repository=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
top=$(mktemp -d)
trap 'chmod -R u+w "$top"; rm -rf "$top"' EXIT
chmod 755 "$top"

# fake NAME: a program of the false machine; its text is read from standard input. It logs how it was called.
fake() {
    printf '#!%s\necho "%s $*" >>"$WORLD/calls"\n%s\n' "$BASH" "$1" "$(</dev/stdin)" >"$world/bin/$1"
    chmod 755 "$world/bin/$1"
}

# A false Debian without sudo on which nothing is installed, of a user without root rights; and a fresh checkout.
make_world() {
    world=$top/world
    mkdir -p "$world"/{bin,home,tmp,checkout/apps/capture,checkout/apps/info,checkout/tools/head}
    touch "$world/calls" "$world/installed"
    echo 1000 >"$world/uid"
    cp "$repository/run" "$world/checkout/run"
    local tool
    for tool in bash env sed sort comm tr mkdir rm cat grep tail awk dirname ls tee chmod touch head cp; do
        ln -s "$(command -v $tool)" "$world/bin/$tool"
    done
    fake id <<<'cat "$WORLD/uid"'
    fake nproc <<<'echo 2'
    fake sleep <<<':'
    fake npm <<<':'
    fake apt-cache <<<':'
    fake cpack <<<'touch cicatrix_1_amd64.deb'
    fake ctest <<<'echo "100% tests passed, 0 tests failed out of 3"'
    fake dpkg <<<':'
    fake dpkg-query <<'END'
for package in "$@"; do
    if grep -qx "$package" "$WORLD/installed"; then echo "$package installed"; fi
done
END
    fake apt-get <<'END'
case "$*" in
    *--print-uris*) echo "'http://mirror/p.deb' p.deb 61000000 MD5Sum:0"; exit ;;
    *install*) printf '%s\n' "$@" | grep '^[a-z]' >>"$WORLD/installed" ;;
esac
END
    fake cmake <<'END'
[[ $* != *--fresh* ]] || rm -f build/CMakeCache.txt
mkdir -p build
touch build/build.ninja
tests=ON
[[ $* != *-DCICATRIX_TESTS=OFF* ]] || tests=OFF
printf 'CICATRIX_TESTS:BOOL=%s\nCMAKE_HOME_DIRECTORY:INTERNAL=%s\n' "$tests" "$PWD" >build/CMakeCache.txt
END
    fake ninja <<'END'
[ "$1" != --quiet ] || shift
[ "$1" = -C ] && cd "$2" || exit 9
printf '#!%s\necho "%s runs: $*"\necho "$CICATRIX_STARTED" >"$WORLD/started"\n' "$BASH" "$PWD/cicatrix" >cicatrix
printf '#!%s\necho "${XDG_CACHE_HOME:-${HOME:-/nowhere}/.cache}/cicatrix/head-v2.glb"\n' "$BASH" >cicatrix-head
chmod 755 cicatrix cicatrix-head
END
    cat >"$world/checkout/tools/head/cicatrix-fetch-head" <<END
#!$BASH
head=\$("\$CICATRIX_HEAD" where)
mkdir -p "\${head%/*}"
touch "\$head"
END
    chmod 755 "$world/checkout/tools/head/cicatrix-fetch-head"
}

with_sudo() { fake sudo <<<'exec "$@"'; }
as_root_user() { echo 0 >"$world/uid"; }

# run ARGUMENTS...: sets code, out (standard output) and err (standard error).
run() { run_with -- "$@"; }

# run_with VARIABLE=VALUE... -- ARGUMENTS...: with these in place of HOME.
run_with() {
    local variables=()
    while [ "$1" != -- ]; do
        variables+=("$1")
        shift
    done
    shift
    [ ${#variables[@]} -gt 0 ] || variables=("HOME=$world/home")
    code=0
    : >"$world/calls"
    "${drop[@]}" env -i PATH="$world/bin" WORLD="$world" BASH="$BASH" TMPDIR="$world/tmp" "${variables[@]}" \
        "${checkout:-$world/checkout}/run" "$@" >"$world/out" 2>"$world/err" </dev/null || code=$?
    out=$(cat "$world/out") err=$(cat "$world/err")
}
drop=()

# Files of the checkout that are not writable are so for root as well only if root gives up its rights.
without_rights() {
    [ "$(id -u)" = 0 ] || return 0
    chown -R 65534:65534 "$world"
    drop=(setpriv --reuid=65534 --regid=65534 --clear-groups)
}

installs() { # PACKAGE: whether it was installed with apt
    grep -qx "$1" "$world/installed"
}

wrong() {
    echo "  wrong: $*"
    failed=yes
}
expect() { "$@" || wrong "$*"; }
expect_not() { ! "$@" || wrong "not: $*"; }
expect_code() { [ "$code" = "$1" ] || wrong "exit code $code, not $1; $err"; }
expect_in() { [[ $1 == *"$2"* ]] || wrong "'$2' is not in: $1"; }
expect_not_in() { [[ $1 != *"$2"* ]] || wrong "'$2' is in: $1"; }
calls() { cat "$world/calls"; }
