// The robot of a world as URDF, for robot_description.
#include <CLI/CLI.hpp>

#include <iostream>

#include "field_fusion/core/sim/urdf.h"
#include "field_fusion/ros/sim_run.h"

int main(int argc, char** argv) {
  CLI::App app("Prints the robot of a simulated world as URDF: its body and where its sensors are.");
  std::string world;
  app.add_option("world", world, "file, or name of a world that comes with the package")->required();
  CLI11_PARSE(app, argc, argv);
  try {
    const std::string file = field_fusion::worldFile(world), sensors = field_fusion::sensorsBeside(file);
    std::cout << field_fusion::core::sim::urdf(field_fusion::core::sim::loadWorld(file, sensors), sensors);
  } catch (const std::exception& e) {
    std::cerr << "world_urdf: " << e.what() << "\n";
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
