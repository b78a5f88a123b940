// Keeps two batches from drawing the same variation into one folder, where each would delete the other's
// work.
#pragma once
#include <filesystem>
#include <string>

namespace batch_command {

/// The names that this process draws into a folder. Each is one locked byte of the file FOLDER/.lock, at the
/// hash of the name (fcntl(2), open file description locks), so the locks end with the object, and with a
/// killed process; they hold between machines where the file system has such locks. The file stays.
class NameLocks
{
  public:
    /// `folder` must exist and be writable.
    explicit NameLocks(std::filesystem::path folder);
    ~NameLocks();
    NameLocks(const NameLocks&) = delete;
    NameLocks& operator=(const NameLocks&) = delete;

    /// Throws base::InputError when somebody else has `name`. On a file system without locks it does nothing.
    void take(const std::string& name);

  private:
    std::filesystem::path folder_;
    int file_ = -1;
};

} // namespace batch_command
