// The detector over topics, with a model whose answer is computed by hand: in a red image of 32x32 px a box
// of 16x8 px around (16, 16), class `red`, score 1 (models/make_fixtures.py).
#include <gtest/gtest.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>

#include <algorithm>
#include <cmath>

#include "field_fusion/GroundPlane.h"
#include "field_fusion/ImageDetectionArray.h"
#include "support/red_image.h"
#include "support/stage_probe.h"

namespace field_fusion::test {
namespace {

/// fx = fy = 20 px, the optical axis at (8, 8) px.
sensor_msgs::CameraInfo infoFor(const sensor_msgs::Image& image) {
  sensor_msgs::CameraInfo info;
  info.header = image.header;
  info.width = info.height = 32;
  info.distortion_model = "plumb_bob";
  info.D.assign(5, 0.0);
  info.K = {20, 0, 8, 0, 20, 8, 0, 0, 1};
  info.R = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  info.P = {20, 0, 8, 0, 0, 20, 8, 0, 0, 0, 1, 0};
  return info;
}

class DetectStage : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(
        spinUntil([this] { return image_.connected() && info_.connected() && detections_.connected(); }));
    static double start = 1000.0;
    now_ = start += 1000.0;
  }
  double next() { return now_ += 0.1; }

  /// Sends images until one with bearing comes out.
  bool works() {
    const int before = detections_.count;
    const auto good = [&] {
      return detections_.count > before && !std::isnan(detections_.last->detections.at(0).azimuth);
    };
    return spinUntil(good, [this] {
      const auto image = redImage(next());
      info_.send(infoFor(image));
      image_.send(image);
    });
  }
  bool reports(const std::string& input, const std::string& kind) {
    return spinUntil([&] { return !diagnostics_.value("detect", input + ": dropped, " + kind).empty(); });
  }
  /// The answer to this very image.
  bool answered(const sensor_msgs::Image& image) {
    return spinUntil(
        [&] { return detections_.last && detections_.last->header.stamp == image.header.stamp; });
  }

  double now_ = 0.0;
  Received<ImageDetectionArray> detections_{"detections"};
  Sender<sensor_msgs::Image> image_{"image"};
  Sender<sensor_msgs::CameraInfo> info_{"camera_info"};
  Sender<GroundPlane> ground_{"ground_plane"};
  Diagnostics diagnostics_;
};

TEST_F(DetectStage, BoxBearingAndRangeAreThoseComputedByHand) {
  const auto image = redImage(next());
  info_.send(infoFor(image));
  image_.send(image);
  ASSERT_TRUE(answered(image));
  EXPECT_EQ(detections_.last->header.frame_id, "camera_optical");
  EXPECT_EQ(detections_.last->width, 32u);
  ASSERT_EQ(detections_.last->detections.size(), 1u);
  const auto& d = detections_.last->detections[0];
  EXPECT_EQ(d.label, "red");
  EXPECT_NEAR(d.score, 1.f, 1e-4);
  EXPECT_NEAR(d.x_min, 8.f, 1e-3);
  EXPECT_NEAR(d.y_max, 20.f, 1e-3);
  // the box centre (16, 16) has the camera model's coordinates (15.5, 15.5): 7.5 px right of and below the
  // axis
  EXPECT_NEAR(d.azimuth, -std::atan(7.5 / 20.0), 1e-5);
  EXPECT_NEAR(d.depth, 20.0 * 1.0 / 8.0, 1e-4);  // Eq. 3: f_y H / h_b
  EXPECT_NEAR(d.range, d.depth * std::sqrt(1.0 + 2.0 * std::pow(7.5 / 20.0, 2)), 1e-4);
  // its corners (8, 12) and (24, 20), 0.5 px less, against the axis at (8, 8)
  EXPECT_NEAR(d.ray_min.x / d.ray_min.z, -0.5 / 20.0, 1e-4);
  EXPECT_NEAR(d.ray_min.y / d.ray_min.z, 3.5 / 20.0, 1e-4);
  EXPECT_NEAR(d.ray_max.x / d.ray_max.z, 15.5 / 20.0, 1e-4);
  EXPECT_NEAR(d.ray_max.y / d.ray_max.z, 11.5 / 20.0, 1e-4);
  EXPECT_EQ(d.range_source, ImageDetection::RANGE_FROM_HEIGHT);
  EXPECT_GT(d.range_sigma, 0.f);
}

// A ground 1 m below the camera: the bottom edge, 11.5 px below the axis, meets it 20 / 11.5 m ahead.
TEST_F(DetectStage, GroundPlaneGivesASecondRange) {
  ASSERT_TRUE(spinUntil([this] { return ground_.connected(); }));
  const auto from_both = [this] {
    return detections_.last && !detections_.last->detections.empty() &&
           detections_.last->detections[0].range_source == ImageDetection::RANGE_FROM_BOTH;
  };
  EXPECT_TRUE(spinUntil(from_both, [this] {
    const auto image = redImage(next());
    GroundPlane ground;
    ground.header = image.header;
    ground.found = true;
    ground.normal.y = -1.0;
    ground.height = 1.0;
    ground_.send(ground);
    info_.send(infoFor(image));
    image_.send(image);
  }));
  const auto& d = detections_.last->detections.at(0);
  EXPECT_GT(d.depth, 20.0 / 11.5);
  EXPECT_LT(d.depth, 20.0 * 1.0 / 8.0);
}

TEST_F(DetectStage, ImageWithoutAnythingGivesAnEmptyArray) {
  ASSERT_TRUE(works());
  auto image = redImage(next());
  std::fill(image.data.begin(), image.data.end(), std::uint8_t{0});
  info_.send(infoFor(image));
  image_.send(image);
  ASSERT_TRUE(answered(image));
  EXPECT_TRUE(detections_.last->detections.empty());
}

TEST_F(DetectStage, UnknownEncodingIsDroppedAndTheNextImageTaken) {
  ASSERT_TRUE(works());
  auto image = redImage(next());
  image.encoding = "no_such_encoding";
  image_.send(image);
  EXPECT_TRUE(reports("image", "image cannot be read"));
  EXPECT_TRUE(works());
}

TEST_F(DetectStage, DataShorterThanTheSizeSaysIsDropped) {
  ASSERT_TRUE(works());
  auto image = redImage(next());
  image.height = 0xffffffff;
  image_.send(image);
  EXPECT_TRUE(reports("image", "image cannot be read"));
  EXPECT_TRUE(works());
}

TEST_F(DetectStage, CameraThatWasNeverCalibratedIsRefused) {
  ASSERT_TRUE(works());
  auto info = infoFor(redImage(next()));
  info.K.assign(0.0);
  info_.send(info);
  EXPECT_TRUE(reports("camera_info", "camera info is not calibrated"));
  EXPECT_TRUE(works());
}

TEST_F(DetectStage, CameraInfoOfAnotherSizeLeavesBoxesWithoutBearing) {
  ASSERT_TRUE(works());
  const auto image = redImage(next(), 64);
  info_.send(infoFor(image));  // says 32x32
  image_.send(image);
  ASSERT_TRUE(answered(image));
  ASSERT_EQ(detections_.last->detections.size(), 1u);
  EXPECT_TRUE(std::isnan(detections_.last->detections[0].azimuth));
  EXPECT_TRUE(std::isnan(detections_.last->detections[0].range));
  EXPECT_TRUE(reports("camera_info", "camera info is of another size"));
  EXPECT_TRUE(works());
}

TEST_F(DetectStage, NewestImageWinsAndSkippedOnesAreCounted) {
  ASSERT_TRUE(works());
  const auto skipped = [this] { return std::atoi(diagnostics_.value("detect", "image: skipped").c_str()); };
  const int before = skipped();
  for (int i = 0; i < 300; ++i) {  // far faster than any detector
    const auto image = redImage(next());
    info_.send(infoFor(image));
    image_.send(image);
  }
  EXPECT_TRUE(works());
  EXPECT_TRUE(spinUntil([&] { return skipped() > before; }));
}

TEST_F(DetectStage, LoopingBagGoesOn) {
  ASSERT_TRUE(works());
  now_ -= 100.0;
  EXPECT_TRUE(works());
}

TEST_F(DetectStage, WithoutCameraInfoBoxesComeWithoutBearing) {
  ASSERT_TRUE(works());
  now_ -= 100.0;  // a jump back in time makes the stage forget its camera
  const auto image = redImage(next());
  image_.send(image);
  ASSERT_TRUE(answered(image));
  ASSERT_EQ(detections_.last->detections.size(), 1u);
  EXPECT_TRUE(std::isnan(detections_.last->detections[0].azimuth));
  EXPECT_EQ(detections_.last->detections[0].range_source, ImageDetection::RANGE_UNKNOWN);
  EXPECT_TRUE(reports("camera_info", "camera info missing"));
  EXPECT_TRUE(works());
}

TEST(AnnotatedImage, HoldsTheBoxes) {
  Received<sensor_msgs::Image> annotated("annotated_image");
  Sender<sensor_msgs::Image> images("image");
  double now = 50'000.0;
  ASSERT_TRUE(spinUntil([&] { return annotated.last != nullptr; },
                        [&] {
                          if (images.connected()) images.send(redImage(now += 0.1));
                        }));
  EXPECT_EQ(annotated.last->encoding, "bgr8");
  EXPECT_EQ(annotated.last->width, 32u);
  const auto other = std::find_if(annotated.last->data.begin(), annotated.last->data.end(),
                                  [](std::uint8_t value) { return value != 0 && value != 255; });
  EXPECT_NE(other, annotated.last->data.end()) << "a red image holds 0 and 255 only: nothing was drawn";
}

}  // namespace
}  // namespace field_fusion::test
