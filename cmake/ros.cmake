# Messages, the ROS layer, the nodelets and the tools.
find_package(catkin REQUIRED COMPONENTS
  camera_info_manager cv_bridge diagnostic_msgs diagnostic_updater dynamic_reconfigure geometry_msgs image_geometry image_transport
  message_filters message_generation nav_msgs nodelet pluginlib rosbag roscpp rosgraph_msgs roslib sensor_msgs std_msgs std_srvs tf2_eigen tf2_msgs tf2_ros
  visualization_msgs)

file(GLOB messages CONFIGURE_DEPENDS RELATIVE ${PROJECT_SOURCE_DIR}/msg msg/*.msg)
add_message_files(FILES ${messages})
file(GLOB services CONFIGURE_DEPENDS RELATIVE ${PROJECT_SOURCE_DIR}/srv srv/*.srv)
add_service_files(FILES ${services})
generate_messages(DEPENDENCIES geometry_msgs std_msgs)
catkin_package(
  INCLUDE_DIRS include
  LIBRARIES field_fusion_core field_fusion_ros
  CATKIN_DEPENDS message_runtime roscpp sensor_msgs std_msgs geometry_msgs
  DEPENDS EIGEN3)

file(GLOB ros_sources CONFIGURE_DEPENDS src/ros/*.cpp)
file(GLOB sim_ros_sources CONFIGURE_DEPENDS src/ros/sim_*.cpp)
list(REMOVE_ITEM ros_sources ${sim_ros_sources})
add_library(field_fusion_ros ${ros_sources})
add_dependencies(field_fusion_ros ${PROJECT_NAME}_generate_messages_cpp ${catkin_EXPORTED_TARGETS})
target_include_directories(field_fusion_ros SYSTEM PUBLIC ${catkin_INCLUDE_DIRS})
target_link_libraries(field_fusion_ros PUBLIC field_fusion_core ${catkin_LIBRARIES})
include(cmake/optional_messages.cmake)

# the simulator, apart from the stages as in core
add_library(field_fusion_sim_ros ${sim_ros_sources})
target_link_libraries(field_fusion_sim_ros PUBLIC field_fusion_ros field_fusion_sim)

file(GLOB nodelet_sources CONFIGURE_DEPENDS src/nodelets/*.cpp)
file(GLOB sim_nodelet_sources CONFIGURE_DEPENDS src/nodelets/sim_*.cpp)
list(REMOVE_ITEM nodelet_sources ${sim_nodelet_sources})
add_library(field_fusion_nodelets ${nodelet_sources})
target_link_libraries(field_fusion_nodelets field_fusion_ros)
add_library(field_fusion_sim_nodelets ${sim_nodelet_sources})
target_link_libraries(field_fusion_sim_nodelets field_fusion_sim_ros)

# the benchmarks were made before catkin named the place where rosrun looks
set_target_properties(${core_programs} PROPERTIES
  RUNTIME_OUTPUT_DIRECTORY ${CATKIN_DEVEL_PREFIX}/${CATKIN_PACKAGE_BIN_DESTINATION})

file(GLOB tool_sources CONFIGURE_DEPENDS src/tools/*.cpp)
foreach(source ${tool_sources})
  get_filename_component(name ${source} NAME_WE)
  add_executable(${name} ${source})
  target_link_libraries(${name} field_fusion_ros)
  list(APPEND tools ${name})
endforeach()
find_package(PCL REQUIRED COMPONENTS registration)
target_link_libraries(make_bag field_fusion_sim_ros)
target_link_libraries(write_params field_fusion_sim)
target_link_libraries(world_urdf field_fusion_sim_ros)
target_link_libraries(seen_outline field_fusion_sim_ros)
target_link_libraries(calibrate_lidar_camera field_fusion_calib)
target_link_libraries(calibrate_camera_imu field_fusion_calib)
target_link_libraries(calibration_coverage field_fusion_calib)
target_link_libraries(kitti_poses ${PCL_REGISTRATION_LIBRARIES})
target_compile_options(kitti_poses PRIVATE -Wno-array-bounds)  # GCC 12 is wrong about Eigen in PCL's header

# benchmarks against ROS itself
file(GLOB bench_sources CONFIGURE_DEPENDS bench/ros/bench_*.cpp)
foreach(source ${bench_sources})
  get_filename_component(name ${source} NAME_WE)
  add_executable(${name} ${source})
  target_link_libraries(${name} core_test_support field_fusion_ros)
  list(APPEND tools ${name})
endforeach()

# these libraries, too, were made before catkin named their place; OpenVINO's is looked for beside core
foreach(library field_fusion_core field_fusion_calib field_fusion_sim ${run_time_libraries})
  set_target_properties(${library} PROPERTIES
    LIBRARY_OUTPUT_DIRECTORY ${CATKIN_DEVEL_PREFIX}/${CATKIN_PACKAGE_LIB_DESTINATION})
endforeach()

include(cmake/scripts.cmake)
include(cmake/install.cmake)
if(CATKIN_ENABLE_TESTING)
  include(cmake/test.cmake)
endif()
