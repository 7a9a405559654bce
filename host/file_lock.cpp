#include "host/file_lock.hpp"

#include <cerrno>
#include <limits>
#include <system_error>

#include <fcntl.h>
#include <unistd.h>

namespace hitpipe::host {

FileLock::FileLock(const std::filesystem::path& file, std::uint64_t number)
    : descriptor_(open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666)) {
  if (descriptor_ < 0) throw std::system_error(errno, std::generic_category());
  struct flock byte {};
  byte.l_type = F_WRLCK;
  byte.l_whence = SEEK_SET;
  byte.l_start = static_cast<off_t>(number & std::numeric_limits<std::int64_t>::max());
  byte.l_len = 1;
  while (fcntl(descriptor_, F_OFD_SETLKW, &byte) != 0 && errno == EINTR) {
  }
}

FileLock::~FileLock() {
  ::close(descriptor_);
}

}  // namespace hitpipe::host
