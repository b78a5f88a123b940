#include "apps/document/document.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <functional>
#include <sstream>
#include <string_view>
#include <vector>

namespace document_command {
namespace {

using Strings = std::vector<std::string>;

std::vector<const CLI::App*> commands_of(const CLI::App& program)
{
    std::vector<const CLI::App*> shown;
    for (const CLI::App* command : program.get_subcommands([](const CLI::App*) { return true; }))
        if (!command->get_group().empty())
            shown.push_back(command);
    return shown;
}

std::vector<const CLI::Option*> options_of(const CLI::App& command)
{
    std::vector<const CLI::Option*> shown;
    for (const CLI::Option* option : command.get_options())
        if (!option->get_group().empty())
            shown.push_back(option);
    return shown;
}

/// All names of an option as typed: "-h", "--help".
Strings spellings(const CLI::Option& option)
{
    Strings all;
    for (const std::string& name : option.get_snames())
        all.push_back("-" + name);
    for (const std::string& name : option.get_lnames())
        all.push_back("--" + name);
    return all;
}

Strings all_spellings(const CLI::App& command)
{
    Strings all;
    for (const CLI::Option* option : options_of(command))
        for (const std::string& one : spellings(*option))
            all.push_back(one);
    return all;
}

bool takes_value(const CLI::Option& option)
{
    return option.get_items_expected_max() > 0;
}

/// The choices a, b of an option whose type name contains {a,b}; empty for other options.
Strings choices_of(const CLI::Option& option)
{
    const std::string type = option.get_type_name();
    const auto open = type.find('{'), close = type.find('}');
    Strings choices;
    if (open == type.npos || close == type.npos)
        return choices;
    std::istringstream list(type.substr(open + 1, close - open - 1));
    for (std::string choice; std::getline(list, choice, ',');)
        choices.push_back(choice);
    return choices;
}

std::string replaced(std::string text, const std::vector<std::pair<char, std::string_view>>& replacements)
{
    std::string result;
    for (const char c : text) {
        const auto found = std::ranges::find(replacements, c, &std::pair<char, std::string_view>::first);
        found == replacements.end() ? result += c : result += found->second;
    }
    return result;
}

/// Escapes text for troff; line ends become .br requests.
std::string troff(const std::string& text)
{
    std::string line = replaced(text, {{'\\', "\\e"}, {'-', "\\-"}, {'\n', "\n.br\n"}});
    if (line.starts_with('.') || line.starts_with('\''))
        line.insert(0, "\\&");
    return line;
}

void document_options(std::string& page, const CLI::App& command)
{
    for (const CLI::Option* option : options_of(command)) {
        std::string head;
        if (option->get_positional())
            head = option->get_type_name();
        else
            head = fmt::format("{}", fmt::join(spellings(*option), ", ")) +
                   (takes_value(*option) ? " " + option->get_type_name() : "");
        page += fmt::format(".TP\n.B {}\n{}", troff(head), troff(option->get_description()));
        if (!option->get_default_str().empty())
            page += fmt::format(" Default: {}.", troff(option->get_default_str()));
        if (option->get_required())
            page += " Required.";
        page += '\n';
    }
}

std::string usage_of(const CLI::App& command)
{
    std::string usage = "cicatrix " + command.get_name() + " [OPTIONS]";
    for (const CLI::Option* option : options_of(command))
        if (option->get_positional())
            usage +=
                option->get_required() ? " " + option->get_type_name() : " [" + option->get_type_name() + "]";
    return usage;
}

/// Makes text safe inside single quotes of a shell: ' becomes an apostrophe, line ends become blanks.
std::string quoted(const std::string& text)
{
    return replaced(text, {{'\'', "’"}, {'\n', " "}});
}

void print_document(const CLI::App& program, const std::string& kind, const std::string& version)
{
    fmt::print("{}", kind == "man"    ? man_page(program, version)
                     : kind == "bash" ? bash_completion(program)
                     : kind == "zsh"  ? zsh_completion(program)
                                      : fish_completion(program));
}

} // namespace

std::string man_page(const CLI::App& program, const std::string& version)
{
    std::string page =
        fmt::format(".TH CICATRIX 1 \"\" \"cicatrix {}\" \"User Commands\"\n.SH NAME\ncicatrix \\- renders a "
                    "wound healing on a face, day by day\n.SH SYNOPSIS\n",
                    version);
    for (const CLI::App* command : commands_of(program))
        page += fmt::format(".B {}\n.br\n", troff(usage_of(*command)));
    page += fmt::format(".SH DESCRIPTION\n{}\n.SH OPTIONS\n", troff(program.get_description()));
    document_options(page, program);
    page += ".SH COMMANDS\n";
    for (const CLI::App* command : commands_of(program)) {
        page += fmt::format(".SS {}\n{}\n", troff(usage_of(*command)), troff(command->get_description()));
        document_options(page, *command);
        page += fmt::format(".PP\n.nf\n{}\n.fi\n", troff(command->get_footer()));
    }
    page += R"(.SH ENVIRONMENT
.TP
.B CICATRIX_DEVICE
Vulkan device by index or part of its name, where \-\-device is not given.
.SH FILES
.TP
.I ~/.cache/cicatrix/head\-v*.glb
The default head, made by cicatrix\-fetch\-head(1); XDG_CACHE_HOME replaces ~/.cache.
.SH EXIT STATUS
.TP
.B 0
All was done.
.TP
.B 1
An error of a file, of an option's value, or of the machine (no Vulkan driver, no display, a full disk); for batch also a variation
that failed. Standard error names the place, the error and a remedy.
.TP
.B 2
A wrong command line: no command, an unknown command or option, a missing value, or a choice that the option does not have.
.TP
.B 130
Stopped by Ctrl\-C, or by SIGTERM while it was drawing; no incomplete file is left. Any other signal N gives 128 + N.
.SH EXAMPLES
.nf
)";
    return page + troff(program.get_footer()) + "\n.fi\n";
}

std::string bash_completion(const CLI::App& program)
{
    Strings words = all_spellings(program), cases, options;
    for (const CLI::App* command : commands_of(program)) {
        const std::string name = command->get_name();
        words.push_back(name);
        options.push_back(
            fmt::format("        {}) words='{}' ;;", name, fmt::join(all_spellings(*command), " ")));
        for (const CLI::Option* option : options_of(*command))
            if (const Strings choices = choices_of(*option); !choices.empty())
                for (const std::string& one : spellings(*option))
                    cases.push_back(
                        fmt::format("        {}:{}) words='{}' ;;", name, one, fmt::join(choices, " ")));
    }
    return fmt::format(R"(# bash completion of cicatrix, written by `cicatrix document bash`
_cicatrix() {{
    local cur=${{COMP_WORDS[COMP_CWORD]}} prev=${{COMP_WORDS[COMP_CWORD-1]}} command=${{COMP_WORDS[1]}} words=
    COMPREPLY=()
    if [ "$COMP_CWORD" = 1 ]; then
        COMPREPLY=($(compgen -W '{}' -- "$cur"))
        return
    fi
    case $command:$prev in
{}
    esac
    [ -n "$words" ] || case $cur in -*) case $command in
{}
    esac ;; esac
    [ -z "$words" ] || COMPREPLY=($(compgen -W "$words" -- "$cur"))
}}
complete -o default -F _cicatrix cicatrix
)",
                       fmt::join(words, " "), fmt::join(cases, "\n"), fmt::join(options, "\n"));
}

std::string zsh_completion(const CLI::App& program)
{
    std::string names, cases;
    for (const CLI::App* command : commands_of(program)) {
        names += fmt::format("        '{}:{}'\n", command->get_name(), quoted(command->get_description()));
        cases += fmt::format("        {})\n            _arguments \\\n", command->get_name());
        for (const CLI::Option* option : options_of(*command)) {
            const Strings choices = choices_of(*option);
            const std::string value = !takes_value(*option) ? ""
                                      : choices.empty()     ? ":value:_files"
                                                        : fmt::format(":value:({})", fmt::join(choices, " "));
            const std::string text =
                replaced(quoted(option->get_description()), {{'[', "("}, {']', ")"}, {':', "\\:"}});
            for (const std::string& one : spellings(*option))
                cases += fmt::format("                '{}[{}]{}' \\\n", one, text, value);
        }
        cases += "                '*:file:_files'\n            ;;\n";
    }
    return fmt::format(R"(#compdef cicatrix
# zsh completion of cicatrix, written by `cicatrix document zsh`
_cicatrix() {{
    local -a commands=(
{}    )
    if (( CURRENT == 2 )); then
        _describe command commands
        compadd -- {}
        return
    fi
    local command=$words[2]
    shift words
    (( CURRENT-- ))
    case $command in
{}    esac
}}
_cicatrix "$@"
)",
                       names, fmt::join(all_spellings(program), " "), cases);
}

std::string fish_completion(const CLI::App& program)
{
    std::string lines = "# fish completion of cicatrix, written by `cicatrix document fish`\n";
    const auto add = [&lines](const CLI::App& command, const std::string& condition) {
        for (const CLI::Option* option : options_of(command)) {
            std::string line = fmt::format("complete -c cicatrix -n '{}'", condition);
            for (const std::string& name : option->get_snames())
                line += " -s " + name;
            for (const std::string& name : option->get_lnames())
                line += " -l " + name;
            if (const Strings choices = choices_of(*option); !choices.empty())
                line += fmt::format(" -x -a '{}'", fmt::join(choices, " "));
            else if (takes_value(*option))
                line += " -r";
            if (!option->get_positional())
                lines += fmt::format("{} -d '{}'\n", line, quoted(option->get_description()));
        }
    };
    add(program, "__fish_use_subcommand");
    for (const CLI::App* command : commands_of(program)) {
        lines += fmt::format("complete -c cicatrix -f -n '__fish_use_subcommand' -a {} -d '{}'\n",
                             command->get_name(), quoted(command->get_description()));
        add(*command, "__fish_seen_subcommand_from " + command->get_name());
    }
    return lines;
}

void add(CLI::App& program)
{
    auto kind = std::make_shared<std::string>();
    CLI::App* command =
        program.add_subcommand("document", "Print the man page or a shell's completion")->group("");
    command->add_option("kind", *kind, "Document to print")
        ->required()
        ->check(CLI::IsMember({"man", "bash", "zsh", "fish"}));
    command->callback([kind, &program] { print_document(program, *kind, CICATRIX_VERSION); });
}

} // namespace document_command
