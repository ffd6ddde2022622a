# The OpenVINO backend of the detector, where OpenVINO is installed (scripts/install_dependencies puts it
# there). 2025.4 and older would switch the C++ ABI of everything that is built after find_package.
if(DEFINED ENV{XDG_DATA_HOME})
  set(data_home $ENV{XDG_DATA_HOME})
else()
  set(data_home $ENV{HOME}/.local/share)
endif()
file(GLOB openvino_hints ${data_home}/field_fusion/openvino/lib/python3*/site-packages/openvino/cmake)
find_package(OpenVINO 2026.4 QUIET COMPONENTS Runtime HINTS ${openvino_hints})
if(OpenVINO_FOUND)
  message(STATUS "OpenVINO ${OpenVINO_VERSION}: ${OpenVINO_DIR}")
  add_library(field_fusion_openvino MODULE src/openvino/openvino_inference.cpp)
  target_link_libraries(field_fusion_openvino PRIVATE opencv_core openvino::runtime)
  target_include_directories(field_fusion_openvino PRIVATE include)
  target_include_directories(field_fusion_openvino SYSTEM PRIVATE ${OpenCV_INCLUDE_DIRS})
  # named here, because it lies in no folder that the loader knows, and has a libtbb of its own
  get_target_property(openvino_file openvino::runtime IMPORTED_LOCATION_RELEASE)
  get_filename_component(openvino_folder ${openvino_file} DIRECTORY)
  set_target_properties(field_fusion_openvino PROPERTIES
    BUILD_WITH_INSTALL_RPATH ON INSTALL_RPATH ${openvino_folder})
  list(APPEND run_time_libraries field_fusion_openvino)
else()
  message(STATUS "no OpenVINO: the detector runs on OpenCV alone")
endif()
