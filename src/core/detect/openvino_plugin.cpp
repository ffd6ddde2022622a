#include "openvino_plugin.h"

#include <dlfcn.h>

#include <filesystem>
#include <stdexcept>
#include <string>

namespace field_fusion::core {
namespace {

constexpr char kLibrary[] = "libfield_fusion_openvino.so";

/// Never closed: the code of the networks that it made lies in it.
OpenVinoFactory* factoryOf(const std::string& library) {
  std::error_code error;
  if (!std::filesystem::exists(library, error))
    throw std::runtime_error(
        "'" + library + "' was not built: no OpenVINO when field_fusion was (scripts/install_dependencies)");
  void* opened = dlopen(library.c_str(), RTLD_NOW | RTLD_LOCAL);
  void* function = opened ? dlsym(opened, kOpenVinoFactory) : nullptr;
  if (function) return reinterpret_cast<OpenVinoFactory*>(function);
  const char* reason = dlerror();
  throw std::runtime_error("OpenVINO cannot be loaded: " + std::string(reason ? reason : library));
}

}  // namespace

std::string openVinoLibrary() {
  Dl_info here{};
  dladdr(reinterpret_cast<const void*>(&openVinoLibrary), &here);
  const std::filesystem::path holder = std::filesystem::absolute(here.dli_fname ? here.dli_fname : "");
  const std::filesystem::path beside = holder.parent_path() / kLibrary;
  const std::filesystem::path above = holder.parent_path().parent_path() / kLibrary;
  std::error_code error;
  const bool is_above = !std::filesystem::exists(beside, error) && std::filesystem::exists(above, error);
  return is_above ? above : beside;  // catkin puts programs in lib/PACKAGE
}

std::unique_ptr<Inference> loadOpenVino(const std::string& library, const OnnxFile& model, int threads) {
  return std::unique_ptr<Inference>(factoryOf(library)(model, threads));
}

}  // namespace field_fusion::core
