#pragma once
// How everything that is drawn looks, in one table.
#include <visualization_msgs/Marker.h>

#include <array>

namespace field_fusion {

/// What is drawn alike is one namespace in RViz, to be switched on and off there.
enum class Layer {
  kLidar,
  kLidarAlone,
  kCamera,
  kBox,
  kBoxAlone,
  kTolerance,
  kPair,
  kBearing,
  kLabel,
  kLabelAlone,
  kLabelCamera
};

struct LayerStyle {
  Layer layer;
  const char* name;  ///< namespace of the markers
  int type;          ///< visualization_msgs::Marker type
  double size;       ///< times the size of spheres, lines or letters that the parameters give
  float red, green, blue, alpha;
};

/// Red for the LiDAR, blue for the camera, as in Figs. 7 and 9-13 of paper 001; what the LiDAR alone sees is
/// quiet.
inline const LayerStyle& styleOf(Layer layer) {
  using M = visualization_msgs::Marker;
  static constexpr std::array<LayerStyle, 11> kTable{{
      {Layer::kLidar, "lidar", M::SPHERE_LIST, 1.0, 0.95f, 0.15f, 0.15f, 1.0f},
      {Layer::kLidarAlone, "lidar_alone", M::SPHERE_LIST, 0.5, 0.80f, 0.35f, 0.30f, 0.7f},
      {Layer::kCamera, "camera", M::SPHERE_LIST, 1.0, 0.20f, 0.45f, 1.00f, 1.0f},
      {Layer::kBox, "box", M::LINE_LIST, 1.5, 0.25f, 0.95f, 0.40f, 1.0f},
      {Layer::kBoxAlone, "box_alone", M::LINE_LIST, 0.5, 0.65f, 0.65f, 0.65f, 0.5f},
      {Layer::kTolerance, "tolerance", M::LINE_LIST, 1.0, 0.95f, 0.80f, 0.25f, 0.9f},
      {Layer::kPair, "pair", M::LINE_LIST, 1.5, 1.00f, 1.00f, 1.00f, 1.0f},
      {Layer::kBearing, "bearing", M::LINE_LIST, 1.0, 0.20f, 0.45f, 1.00f, 0.6f},
      {Layer::kLabel, "label", M::TEXT_VIEW_FACING, 1.0, 1.00f, 1.00f, 1.00f, 1.0f},
      {Layer::kLabelAlone, "label_alone", M::TEXT_VIEW_FACING, 0.8, 0.75f, 0.75f, 0.75f, 0.9f},
      {Layer::kLabelCamera, "label_camera", M::TEXT_VIEW_FACING, 1.0, 0.55f, 0.75f, 1.00f, 1.0f},
  }};
  return kTable[static_cast<std::size_t>(layer)];
}

}  // namespace field_fusion
