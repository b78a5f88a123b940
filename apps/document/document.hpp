// The man page and the shell completions, generated from the CLI11 commands and options that --help prints.
// The build calls the hidden command `cicatrix document KIND > FILE`.
#pragma once
#include <CLI/CLI.hpp>
#include <string>

namespace document_command {

/// troff with the macros of man(7). Like --help, all four omit commands and options without a group.
std::string man_page(const CLI::App& program, const std::string& version);
/// Completes commands, options and their choices; otherwise file names.
std::string bash_completion(const CLI::App& program);
std::string zsh_completion(const CLI::App& program);
std::string fish_completion(const CLI::App& program);

/// The callback refers to `program`, which must outlive the parsing.
void add(CLI::App& program);

} // namespace document_command
