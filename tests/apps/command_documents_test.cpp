// The man page and the completions against --help; every --help has an example.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <regex>
#include <set>

#include "tests/support/process.hpp"
#include "tests/support/temporary_folder.hpp"

namespace {

using testing::HasSubstr;

std::string help(const std::vector<std::string>& command)
{
    std::vector<std::string> arguments = command;
    arguments.push_back("--help");
    const Outcome outcome = run_program(arguments);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return outcome.out;
}

std::set<std::string> found(const std::string& text, const std::string& pattern)
{
    std::set<std::string> all;
    const std::regex expression(pattern);
    for (std::sregex_iterator i(text.begin(), text.end(), expression), end; i != end; ++i)
        all.insert((*i)[1]);
    return all;
}

/// The commands in the program's help: words indented by two blanks below "Subcommands:".
std::set<std::string> commands()
{
    const std::string text = help({});
    return found(text.substr(std::min(text.find("Subcommands:"), text.size())), "\n  ([a-z][a-z-]*) ");
}

/// The options at the beginning of lines of help.
std::set<std::string> options(const std::string& text)
{
    return found(text, "\n  (?:-[a-z],)?(--[a-z][a-z-]*)");
}

std::string document(const std::string& kind)
{
    const Outcome outcome = run_program({"document", kind});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return outcome.out;
}

/// The text from the first `begin` to the next `end`; empty where there is no `begin`.
std::string between(const std::string& text, const std::string& begin, const std::string& end)
{
    const std::size_t from = text.find(begin);
    return from == text.npos ? "" : text.substr(from, text.find(end, from + begin.size()) - from);
}

} // namespace

TEST(CommandDocuments, HoldEveryCommandAndOptionOfTheHelp)
{
    const std::string man = document("man"), bash = document("bash"), zsh = document("zsh"),
                      fish = document("fish");
    ASSERT_GE(commands().size(), 9u);
    for (const std::string& command : commands()) {
        const std::set<std::string> names = options(help({command}));
        EXPECT_THAT(names, testing::Contains("--help")) << command;
        const std::string section =
            between(man, ".SS cicatrix " + std::regex_replace(command, std::regex("-"), "\\-"), ".SS");
        const std::string words = between(bash, fmt::format("        {}) words=", command), ";;");
        const std::string zsh_words = between(zsh, fmt::format("        {})\n", command), ";;");
        for (const std::string& name : names) {
            EXPECT_THAT(section, HasSubstr(std::regex_replace(name, std::regex("-"), "\\-"))) << command;
            EXPECT_THAT(words, testing::ContainsRegex(name + "[ ']")) << command;
            EXPECT_THAT(zsh_words, HasSubstr("'" + name + "[")) << command;
            EXPECT_THAT(fish, testing::ContainsRegex(
                                  fmt::format("from {}'( -s .)* -l {}[ \n]", command, name.substr(2))));
        }
    }
    EXPECT_THAT(bash, HasSubstr("capture:--mode) words='published corrected'"));
}

TEST(CommandDocuments, EveryHelpHasAnExample)
{
    EXPECT_THAT(help({}), HasSubstr("Example: cicatrix "));
    for (const std::string& command : commands())
        EXPECT_TRUE(
            std::regex_search(help({command}), std::regex("Examples?:\\s+cicatrix " + command + "\\b")))
            << command << ": " << help({command});
}

TEST(CommandDocuments, BashCompletesCommandsOptionsAndChoices)
{
    const TemporaryFolder folder;
    const std::string script = folder.with("cicatrix.bash", document("bash")).string();
    const auto completed = [&](const std::string& words) {
        const std::string command = fmt::format(
            "bash --norc -c 'source {}; COMP_WORDS=({}); COMP_CWORD=$((${{#COMP_WORDS[@]}}-1)); _cicatrix; "
            "echo \"${{COMPREPLY[*]}}\"' > {}",
            script, words, (folder / "out").string());
        EXPECT_EQ(std::system(command.c_str()), 0);
        std::ifstream out(folder / "out");
        std::string line;
        std::getline(out, line);
        return line;
    };
    EXPECT_EQ(completed("cicatrix capt"), "capture");
    EXPECT_EQ(completed("cicatrix wound --re"), "--rect");
    EXPECT_EQ(completed("cicatrix capture --mode p"), "published");
}
