#include "field_fusion/core/io/replace_file.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <stdexcept>

namespace field_fusion::core {

void replaceFile(const std::filesystem::path& file, const std::function<void(std::ostream&)>& write) {
  std::filesystem::path part = file;
  part += "." + std::to_string(::getpid()) + ".part";
  errno = 0;
  std::ofstream out(part, std::ios::binary);
  write(out);
  out.close();
  std::string why = out ? "" : std::strerror(errno != 0 ? errno : EIO);
  std::error_code failed;
  if (out) std::filesystem::rename(part, file, failed);
  if (out && !failed) return;
  if (failed) why = failed.message();
  std::filesystem::remove(part, failed);
  throw std::runtime_error("cannot write " + file.string() + ": " + why);
}

}  // namespace field_fusion::core
