// The man page and the shells' completions, written from the same description of commands and options that
// --help prints, so that they cannot disagree. The build calls the hidden command `cicatrix document KIND >
// FILE`.
#pragma once
#include <CLI/CLI.hpp>
#include <string>

namespace document_command {

/// troff with the macros of man(7); what belongs to no group of the help is left out, here and below.
std::string man_page(const CLI::App& program, const std::string& version);
/// Commands, options, their choices; else names of files.
std::string bash_completion(const CLI::App& program);
std::string zsh_completion(const CLI::App& program);
std::string fish_completion(const CLI::App& program);

/// Keeps `program`, which must outlive the parsing.
void add(CLI::App& program);

} // namespace document_command
