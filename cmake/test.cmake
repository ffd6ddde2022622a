# Unit tests of core and ros, one rostest a stage, and the check of the launch files.
find_package(rostest REQUIRED)
find_package(roslaunch REQUIRED)

catkin_add_gtest(core_test ${core_test_sources})
target_link_libraries(core_test core_test_support gtest_main)

file(GLOB ros_test_sources CONFIGURE_DEPENDS test/ros/*_test.cpp)
catkin_add_gtest(ros_test ${ros_test_sources})
target_link_libraries(ros_test core_test_support field_fusion_ros gtest_main)

# a stage's test: test/ros/NAME.test starts it and test/ros/NAME_rostest.cpp talks to it
file(GLOB rostest_sources CONFIGURE_DEPENDS test/ros/*_rostest.cpp)
foreach(source ${rostest_sources})
  get_filename_component(target ${source} NAME_WE)
  string(REPLACE "_rostest" "" name ${target})
  add_rostest_gtest(${target} test/ros/${name}.test ${source} test/support/rostest_main.cpp)
  target_link_libraries(${target} core_test_support field_fusion_ros)
endforeach()

roslaunch_add_file_check(launch)
