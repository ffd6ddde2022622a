# Messages of a package that was looked for and may be missing: with it, field_fusion_ros gets the source that makes them and the
# definition that says so; without it, the build says `otherwise`.
function(add_optional_messages package source definition otherwise)
  if(NOT ${package}_FOUND)
    message(STATUS "no ${package}: ${otherwise}")
    return()
  endif()
  message(STATUS "${package} ${${package}_VERSION}: ${${package}_DIR}")
  target_sources(field_fusion_ros PRIVATE ${PROJECT_SOURCE_DIR}/${source})
  target_compile_definitions(field_fusion_ros PUBLIC ${definition})
  target_include_directories(field_fusion_ros SYSTEM PUBLIC ${${package}_INCLUDE_DIRS})
  if(${package}_EXPORTED_TARGETS)
    add_dependencies(field_fusion_ros ${${package}_EXPORTED_TARGETS})
  endif()
endfunction()

# Debian has neither; ros-noetic-vision-msgs and ros-noetic-octomap-msgs do.
find_package(vision_msgs QUIET)
add_optional_messages(vision_msgs src/vision/vision_message.cpp FIELD_FUSION_VISION_MSGS
                      "obstacles go out in our own messages alone")
find_package(octomap_msgs QUIET)
add_optional_messages(octomap_msgs src/octomap/octomap_message.cpp FIELD_FUSION_OCTOMAP_MSGS
                      "voxels go out as markers and files alone")
