// The main of every stage test: test/ros/*.test names the node.
#include <gtest/gtest.h>
#include <ros/ros.h>

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "rostest");
  const ros::NodeHandle keep;  // roscpp ends with the last of them, and the fixtures come and go
  return RUN_ALL_TESTS();
}
