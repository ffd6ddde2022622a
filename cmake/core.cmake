# The algorithms: Eigen, PCL and OpenCV, no ROS. Tests and benchmarks that need no ROS either.
find_package(Eigen3 REQUIRED NO_MODULE)
find_package(PCL REQUIRED COMPONENTS common search kdtree segmentation)
find_package(OpenCV REQUIRED COMPONENTS calib3d core imgproc imgcodecs dnn)
find_package(Ceres REQUIRED)
find_package(octomap REQUIRED)
find_package(yaml-cpp REQUIRED)
find_package(embree 3 REQUIRED)
find_package(assimp REQUIRED)
find_package(Threads REQUIRED)

file(GLOB_RECURSE core_sources CONFIGURE_DEPENDS src/core/*.cpp)
file(GLOB_RECURSE sim_sources CONFIGURE_DEPENDS src/core/sim/*.cpp)
file(GLOB_RECURSE calib_sources CONFIGURE_DEPENDS src/core/calib/*.cpp)
list(REMOVE_ITEM core_sources ${sim_sources} ${calib_sources})
add_library(field_fusion_core ${core_sources})
target_include_directories(field_fusion_core PUBLIC include)
target_include_directories(field_fusion_core SYSTEM PUBLIC ${PCL_INCLUDE_DIRS} ${OpenCV_INCLUDE_DIRS} ${OCTOMAP_INCLUDE_DIRS})
target_link_libraries(field_fusion_core PUBLIC Eigen3::Eigen ${OpenCV_LIBS} ${PCL_LIBRARIES} ${OCTOMAP_LIBRARIES} yaml-cpp Threads::Threads ${CMAKE_DL_LIBS})

# the simulator: a library of its own, so that a robot in the field needs neither Embree nor assimp
add_library(field_fusion_sim ${sim_sources})
target_link_libraries(field_fusion_sim PUBLIC field_fusion_core PRIVATE embree assimp::assimp)
# loops become vectors, and round as they would alone: nobody asks for errno or traps, and no two operations
# are fused, so that the same seed gives the same bits on every machine
target_compile_options(field_fusion_sim PRIVATE -fno-math-errno -fno-trapping-math -ffp-contract=off)

# calibration: likewise, for Ceres
add_library(field_fusion_calib ${calib_sources})
target_include_directories(field_fusion_calib SYSTEM PRIVATE ${CERES_INCLUDE_DIRS})
target_link_libraries(field_fusion_calib PUBLIC field_fusion_core PRIVATE ${CERES_LIBRARIES})

file(GLOB_RECURSE core_test_sources CONFIGURE_DEPENDS test/core/*_test.cpp)
add_library(core_test_support INTERFACE)
target_include_directories(core_test_support INTERFACE test)
target_compile_definitions(core_test_support INTERFACE PROJECT_DIR="${PROJECT_SOURCE_DIR}")
target_link_libraries(core_test_support INTERFACE field_fusion_calib field_fusion_sim)

file(GLOB core_bench_sources CONFIGURE_DEPENDS bench/bench_*.cpp)
foreach(source ${core_bench_sources})
  get_filename_component(name ${source} NAME_WE)
  add_executable(${name} ${source})
  target_link_libraries(${name} core_test_support)
  list(APPEND core_programs ${name})
endforeach()
