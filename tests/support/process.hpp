// Runs the built program as its user does.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

struct Outcome
{
    int code = -1;        // exit code, or 128 + the signal that ended it
    std::string out, err; // all it printed
};

/// `environment`: VARIABLE=value, added to the variables of the test.
Outcome run_program(const std::vector<std::string>& arguments,
                    const std::vector<std::string>& environment = {}, const std::string& name = "cicatrix");

std::string program_path(const std::string& name = "cicatrix");
