# Python programs for rosrun: started through relays in the devel space. The scripts themselves are not
# executable, or rosrun would find each a second time below catkin_ws/ when both ways to build were used.
set(scripts calibrate_imu labelme_to_yolo reproduce score_kitti sim_view)
foreach(script ${scripts})
  configure_file(cmake/script.in ${CATKIN_DEVEL_PREFIX}/${CATKIN_PACKAGE_BIN_DESTINATION}/${script} @ONLY)
  install(PROGRAMS scripts/${script} DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})
endforeach()
install(DIRECTORY scripts/support DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION} USE_SOURCE_PERMISSIONS
  PATTERN __pycache__ EXCLUDE)
