#!/usr/bin/env bash
# Tests of the script `run`: each starts a copy of it in a checkout of its own, with false programs for everything
# that would install, build or need root rights. Needs no network, no root rights and no build.
#
#   run_test.sh          all tests
#   run_test.sh NAME     one of them
set -uo pipefail
# shellcheck source=tests/run/false_machine.sh
source "$(dirname "${BASH_SOURCE[0]}")/false_machine.sh"

# ---- The command is checked first --------------------------------------------------------------------------

test_usage_without_installing() {
    local arguments
    for arguments in "" --help -h help nonsense ../apps --version; do
        # shellcheck disable=SC2086 # none is no argument
        run $arguments
        expect_in "$out$err" "./run capture [OPTIONS]"
        expect_in "$out$err" "Commands of the program: capture info"
        expect_not_in "$(calls)" apt-get
        expect_not_in "$(calls)" ninja
    done
}

test_exit_code_of_a_wrong_command_is_2() {
    run nonsense
    expect_code 2
    expect_in "$err" "there is no command 'nonsense'"
    expect [ -z "$out" ]
    run
    expect_code 2
    run --help
    expect_code 0
    expect [ -z "$err" ]
}

# ---- What is fetched is said first -------------------------------------------------------------------------

test_first_call_says_size_and_time_then_runs() {
    with_sudo
    run capture --size 64x64
    expect_code 0
    expect_in "$out" "build/cicatrix runs: capture --size 64x64"
    expect_in "$err" "5 minutes on two cores"
    expect_in "$err" "89 MB, and 82 MB"
    expect_in "$err" "61.0 MB"
    expect_in "$err" "(sudo)"
}

test_second_call_only_runs() {
    with_sudo
    run capture
    run capture
    expect_code 0
    expect [ -z "$err" ]
    expect_not_in "$(calls)" apt-get
    expect_not_in "$(calls)" "cmake --preset"
}

test_size_is_known_after_the_lists_are_fetched() {
    as_root_user
    fake apt-get <<'END'
case "$*" in
    *update*) touch "$WORLD/lists" ;;
    *--print-uris*) [ ! -e "$WORLD/lists" ] || echo "'http://mirror/p.deb' p.deb 7000000 MD5Sum:0" ;;
esac
END
    run info
    expect_code 0
    expect_in "$err" "to build and to render, 7.0 MB"
}

test_the_program_counts_its_time_from_its_own_start() {
    as_root_user
    run info
    local before=$EPOCHREALTIME
    run info
    expect [ "$(cat "$world/started")" \> "${before/,/.}" ]
}

# ---- Installing --------------------------------------------------------------------------------------------

test_missing_sudo_is_said() {
    run capture
    expect_code 1
    expect_in "$err" "so is sudo; as root: apt-get install --no-install-recommends"
    expect_not_in "$(calls)" "apt-get install"
}

test_waits_for_the_lock_of_apt() {
    as_root_user
    fake apt-get <<'END'
[[ $* == *"install -y"* ]] || exit 0
[[ $* == *DPkg::Lock::Timeout=* ]] || exit 100
for i in 1 2 3; do echo "Waiting for cache lock: Could not get lock /var/lib/dpkg/lock-frontend."; done
END
    run info
    expect_code 0
    expect [ "$(grep -c 'waiting for it' <<<"$err")" = 1 ]
}

test_waits_for_the_lock_of_the_package_lists() {
    as_root_user
    fake apt-get <<'END'
[[ $* == *update* ]] || exit 0
[ ! -e "$WORLD/second" ] || exit 0
touch "$WORLD/second"
echo "E: Could not get lock /var/lib/apt/lists/lock. It is held by process 7 (apt-get)"
exit 100
END
    run info
    expect_code 0
    expect_in "$err" "another program refreshes the package lists"
    expect [ "$(grep -c 'apt-get.*update' "$world/calls")" = 2 ]
}

test_finishes_an_interrupted_installation() {
    as_root_user
    fake dpkg <<<'[ "$*" != "--configure -a" ] || touch "$WORLD/finished"'
    fake apt-get <<'END'
[[ $* != *--print-uris* ]] || exit 0
[ -e "$WORLD/finished" ] || {
    echo "E: dpkg was interrupted, you must manually run 'dpkg --configure -a' to correct the problem."
    exit 100
}
END
    run info
    expect_code 0
    expect_in "$err" "finishing it with dpkg --configure -a"
    expect_in "$out" "runs: info"
}

test_an_installation_that_cannot_be_finished_ends() {
    as_root_user
    fake dpkg <<<'echo "dpkg: error: it is broken"; exit 1'
    fake apt-get <<<'echo "E: dpkg was interrupted, you must manually run it"; exit 100'
    run info
    expect_code 1
    expect_in "$err" "it is broken"
    expect [ "$(grep -c 'dpkg --configure' "$world/calls")" -le 2 ]
}

test_last_error_of_apt_is_printed() {
    as_root_user
    fake apt-get <<'END'
[[ $* == *install* ]] || exit 0
echo "E: You don't have enough free space in /var/cache/apt/archives/."
exit 100
END
    run info
    expect_code 1
    expect_in "$err" "You don't have enough free space"
    expect_in "$err" "log: $world/home/.cache/cicatrix/setup.log"
    expect_in "$(cat "$world/home/.cache/cicatrix/setup.log")" "enough free space"
}

test_error_of_sudo_is_printed() {
    fake sudo <<<'echo "ann is not in the sudoers file." >&2; exit 1'
    run info
    expect_code 1
    expect_in "$err" "ann is not in the sudoers file"
}

# ---- Only what the command needs ---------------------------------------------------------------------------

test_packages_of_the_tests_are_for_test_alone() {
    as_root_user
    run capture
    local package
    for package in libgtest-dev libgmock-dev vulkan-validationlayers xvfb ffmpeg dpkg-dev; do
        expect_not installs "$package"
    done
    expect_in "$(calls)" "-DCICATRIX_TESTS=OFF"
    run capture --video film.mp4
    expect installs ffmpeg
    run test
    expect_code 0
    expect installs libgtest-dev
    expect installs xvfb
    expect_in "$(calls)" "-DCICATRIX_TESTS=ON"
    expect_in "$(calls)" "cicatrix_tests"
    expect_in "$err" "3 tests, 0 failed, 0 skipped"
    run capture
    expect_not_in "$(calls)" "cmake --preset" # tests that are on stay on
}

test_package_builds_no_tests_and_needs_no_head() {
    as_root_user
    run package
    expect_code 0
    expect_in "$(calls)" "build cicatrix cicatrix-head documents"
    expect_not_in "$(calls)" "build all"
    expect_not_in "$(calls)" "cicatrix_tests"
    expect_not_in "$err" "default head"
    expect_in "$err" "made $world/checkout/build/cicatrix_1_amd64.deb"
}

test_failing_and_skipped_tests_are_failures() {
    as_root_user
    fake ctest <<<'echo "99% tests passed, 1 tests failed out of 3"; exit 8'
    run test
    expect_code 8
    fake ctest <<<'echo "1/1 Test #1: A ...***Skipped"; echo "100% tests passed, 0 tests failed out of 3"'
    run_with "HOME=$world/home" CICATRIX_NO_SKIPS=1 -- test
    expect_code 1
    run test
    expect_code 0
}

# ---- Where the checkout and the home folder are ------------------------------------------------------------

test_copied_checkout_is_built_anew() {
    as_root_user
    run info
    cp -R "$world/checkout" "$world/copy"
    checkout=$world/copy
    run info
    expect_code 0
    expect_in "$out" "$world/copy/build/cicatrix runs: info"
    expect_in "$(calls)" "--fresh"
    expect_in "$err" "was made for $world/checkout"
    expect_in "$err" "builds the program"
    run info
    expect_not_in "$(calls)" "cmake --preset"
}

test_copy_that_cannot_be_configured_does_not_run_the_old_program() {
    as_root_user
    run info
    mv "$world/checkout" "$world/moved"
    checkout=$world/moved
    fake cmake <<<'echo "no compiler"; exit 1'
    for _ in first second; do
        run info
        expect_code 1
        expect_in "$err" "no compiler"
        expect [ -z "$out" ]
    done
}

test_checkout_behind_a_link_is_the_same() {
    as_root_user
    run info
    ln -s "$world/checkout" "$world/link"
    checkout=$world/link
    run info
    expect_code 0
    expect_not_in "$(calls)" "cmake --preset"
}

test_unwritable_checkout_with_a_program_runs_it() {
    as_root_user
    run capture
    echo 65534 >"$world/uid"
    chmod -R a-w "$world/checkout"
    without_rights
    : >"$world/installed"
    run capture --days 3
    expect_code 0
    expect_in "$out" "runs: capture --days 3"
    expect [ -z "$err" ]
    run test
    expect_code 1
    expect_in "$err" "cannot write to $world/checkout"
}

test_unwritable_checkout_without_a_program_says_so() {
    chmod a-w "$world/checkout"
    without_rights
    run capture
    expect_code 1
    expect_in "$err" "nothing can be built there"
    expect_not_in "$(calls)" apt-get
}

test_without_home_a_private_folder_is_used_again() {
    as_root_user
    run_with NOTHING=1 -- capture
    expect_code 0
    local private=$world/tmp/cicatrix-0
    expect_in "$err" "using $private instead"
    expect [ -e "$private/cicatrix/head-v2.glb" ]
    expect [ "$(stat -c %a "$private")" = 700 ]
    run_with NOTHING=1 -- capture
    expect_not_in "$err" "default head"
}

test_unwritable_home_with_a_head_only_runs() {
    as_root_user
    run capture
    echo 65534 >"$world/uid"
    chmod -R a-w "$world/home"
    without_rights
    run capture
    expect_code 0
    expect [ -z "$err" ]
    expect_in "$out" "runs: capture"
}

test_folder_of_somebody_else_is_not_used() {
    as_root_user
    mkdir "$world/elsewhere"
    ln -s "$world/elsewhere" "$world/tmp/cicatrix-0"
    run_with HOME=/dev/null -- capture
    expect_code 1
    expect_in "$err" "set XDG_CACHE_HOME"
    expect_not_in "$(calls)" apt-get
}

# ------------------------------------------------------------------------------------------------------------

mapfile -t tests < <(compgen -A function test_)
[ $# = 0 ] || tests=("test_${1#test_}")
make_world
template=$world
for one in "${tests[@]}"; do
    [ "$(jobs -rp | wc -l)" -lt "$(nproc)" ] || wait -n
    {
        world=$top/$one
        cp -a "$template" "$world"
        (failed= && "$one" && [ -z "$failed" ]) || echo "FAILED $one"
    } >"$top/$one.printed" 2>&1 &
done
wait
cat "$top"/*.printed
failures=$(cat "$top"/*.printed | grep -c '^FAILED')
echo "${#tests[@]} tests of run, $failures failed"
[ "$failures" = 0 ]
