#include "tests/support/process.hpp"

#include <cstdlib>
#include <fmt/ranges.h>
#include <fstream>
#include <sstream>
#include <sys/wait.h>

#include "tests/support/temporary_folder.hpp"

namespace {

std::string quoted(const std::string& word)
{
    std::string result = "'";
    for (const char c : word)
        if (c == '\'')
            result += "'\\''";
        else
            result += c;
    result += "'";
    return result;
}

std::string text_of(const std::filesystem::path& file)
{
    std::ostringstream text;
    text << std::ifstream(file, std::ios::binary).rdbuf();
    return text.str();
}

} // namespace

std::string program_path(const std::string& name)
{
    return std::string(CICATRIX_PROGRAMS) + "/" + name;
}

Outcome run_program(const std::vector<std::string>& arguments, const std::vector<std::string>& environment,
                    const std::string& name)
{
    const TemporaryFolder folder;
    std::vector<std::string> words{"env"};
    for (const std::string& variable : environment)
        words.push_back(quoted(variable));
    words.push_back(quoted(program_path(name)));
    for (const std::string& argument : arguments)
        words.push_back(quoted(argument));
    const std::filesystem::path out = folder / "out", err = folder / "err";
    const std::string command =
        fmt::format("{} >{} 2>{} </dev/null", fmt::join(words, " "), quoted(out), quoted(err));
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), text_of(out), text_of(err)};
}
