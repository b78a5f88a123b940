#include "apps/batch/name_locks.hpp"

#include <cerrno>
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include "base/hash.hpp"
#include "base/input_error.hpp"

namespace batch_command {

NameLocks::NameLocks(std::filesystem::path folder)
    : folder_(std::move(folder)),
      file_(::open((folder_ / ".lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666))
{
}

NameLocks::~NameLocks()
{
    if (file_ >= 0)
        ::close(file_);
}

void NameLocks::take(const std::string& name)
{
    struct flock lock = {};
    lock.l_type = F_WRLCK;
    lock.l_whence = SEEK_SET;
    lock.l_start = off_t(base::Hash().add(std::string_view(name)).value() >> 2); // an offset is not negative
    lock.l_len = 1;
    if (file_ >= 0 && ::fcntl(file_, F_OFD_SETLK, &lock) != 0 && (errno == EAGAIN || errno == EACCES))
        throw base::InputError(
            folder_.string(), fmt::format("another batch is drawing \"{}\" here", name),
            "wait until it has ended, give each its --share, or name another folder with --out");
}

} // namespace batch_command
