#pragma once
// Joins what is seen through a body's openings to the body: seats behind a windscreen are not a body of
// their own.
#include <cstdint>
#include <vector>

#include "field_fusion/core/base/types.h"
#include "field_fusion/core/cloud/oriented_box.h"

namespace field_fusion::core {

/// A set of at most a quarter of another's points belongs to it when half of its points or more are enclosed.
/// A point is enclosed where points of the other set lie in front of it, by at most `depth` and to the side
/// by at most `reach`, and either it is framed, or it lies in that set's oriented box, grown by 0.15 m, and
/// the box is no wider than `depth`. It is framed, as by a window, where some of those points are higher and
/// some lower as seen from the sensor, its set is no more than half as high as the other, and the other no
/// longer than 2 `depth`. So a person before a wall, beside one end of it or behind a fence stays a body.
///
/// Of several such sets the one that encloses the most points has it, of equals the nearest: two bodies are
/// never joined by what lies between them. Keeps its buffers.
class SeenThrough {
 public:
  /// `labels`: the set 0 ... count - 1 of each point, or kNoise; `reach`, `depth` [m] > 0. The result has the
  /// same form, with fewer sets, and stays valid until the next call. The order of the points has no say.
  const std::vector<int>& run(const Cloud& cloud, const std::vector<int>& labels, int count, double reach,
                              double depth);

  int clusterCount() const { return cluster_count_; }

 private:
  struct Ray {
    float azimuth;  // [rad] from the middle of its set, so that no set ends at +-pi
    float slope;    // tangent of the elevation
    float range;    // [m]
    std::uint32_t index;
  };
  struct Set {
    IndexRange rays;
    float middle = 0.f;                   // [rad] azimuth of the middle
    float low = 0.f, high = 0.f;          // [rad] azimuths of the outermost rays, from the middle
    float nearest = 0.f, farthest = 0.f;  // [m]
    float tall = 0.f;                     // [m]
    bool ready = false;                   // rays sorted by azimuth, box fitted
    OrientedBox box;
    int holder = -1;             // the set that it belongs to
    std::uint32_t enclosed = 0;  // its points that the holder encloses
  };

  void collect(const Cloud& cloud, const std::vector<int>& labels, int count);
  void measure(Set& set, const Cloud& cloud);
  void prepare(Set& set, const Cloud& cloud);
  bool mayHold(const Set& outer, const Set& inner) const;
  std::uint32_t countEnclosed(const Set& outer, const Set& inner, const Cloud& cloud) const;
  void offer(int outer, Set& inner, std::uint32_t enclosed);
  void number(const std::vector<int>& labels);
  bool mayFrame(const Set& outer, const Set& inner) const;
  bool encloses(const Set& outer, bool frames, const Ray& ray, float azimuth, const Point& point) const;

  float reach_ = 0.f, depth_ = 0.f;
  std::vector<Ray> rays_;  // by set
  std::vector<Set> sets_;
  std::vector<Point> points_;
  OrientedBoxFitter fitter_;
  std::vector<int> place_;
  std::vector<int> labels_;
  int cluster_count_ = 0;
};

}  // namespace field_fusion::core
