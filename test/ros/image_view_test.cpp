// Every encoding that a camera sends, against colours that are computed by hand.
#include <gtest/gtest.h>

#include <boost/make_shared.hpp>

#include <functional>

#include "field_fusion/ros/detection.h"
#include "support/faults.h"

namespace field_fusion {
namespace {

constexpr int kSide = 8;
using Pixel = std::vector<std::uint8_t>;

/// An image whose pixel at (x, y) is `at(x, y)`.
sensor_msgs::Image::ConstPtr image(const std::string& encoding, const std::function<Pixel(int, int)>& at) {
  auto made = boost::make_shared<sensor_msgs::Image>();
  made->encoding = encoding;
  made->width = made->height = kSide;
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      const Pixel pixel = at(x, y);
      made->data.insert(made->data.end(), pixel.begin(), pixel.end());
    }
  made->step = static_cast<std::uint32_t>(made->data.size() / kSide);
  return made;
}

std::function<Pixel(int, int)> all(Pixel pixel) {
  return [pixel](int, int) { return pixel; };
}

/// Red, green and blue of the middle of the image, whichever order it has.
std::vector<int> colour(const sensor_msgs::Image::ConstPtr& message) {
  const ImageView view = viewOf(message);
  EXPECT_EQ(view.pixels.type(), CV_8UC3);
  EXPECT_EQ(view.pixels.size(), cv::Size(kSide, kSide));
  const auto p = view.pixels.at<cv::Vec3b>(kSide / 2, kSide / 2);
  if (view.order == core::PixelOrder::kRgb) return {p[0], p[1], p[2]};
  return {p[2], p[1], p[0]};
}

using Colour = std::vector<int>;

void expectNear(const Colour& found, const Colour& expected, int tolerance) {
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(found[i], expected[i], tolerance) << "channel " << i;
}

TEST(ViewOf, TakesColourAsItComes) {
  const auto bgr = image("bgr8", all({30, 20, 10}));
  const auto rgb = image("rgb8", all({10, 20, 30}));
  EXPECT_EQ(colour(bgr), (Colour{10, 20, 30}));
  EXPECT_EQ(colour(rgb), (Colour{10, 20, 30}));
  EXPECT_EQ(viewOf(bgr).pixels.data, bgr->data.data()) << "copied";
  EXPECT_EQ(viewOf(rgb).pixels.data, rgb->data.data()) << "copied";
}

TEST(ViewOf, TakesGreyAsItComes) {
  const auto mono = image("mono8", all({77}));
  EXPECT_EQ(viewOf(mono).pixels.type(), CV_8UC1);
  EXPECT_EQ(viewOf(mono).pixels.data, mono->data.data()) << "copied";
}

TEST(ViewOf, DropsAlpha) {
  EXPECT_EQ(colour(image("rgba8", all({10, 20, 30, 99}))), (Colour{10, 20, 30}));
  EXPECT_EQ(colour(image("bgra8", all({30, 20, 10, 99}))), (Colour{10, 20, 30}));
}

// ITU-R BT.601, Y 16..235: R = 1.164 (Y - 16) + 1.596 (V - 128), G = ... - 0.392 (U - 128) - 0.813 (V - 128),
// B = ... + 2.017 (U - 128). The bytes are U Y V Y.
TEST(ViewOf, TurnsYuv422IntoColour) {
  const auto uyvy = [](std::uint8_t y, std::uint8_t u, std::uint8_t v) {
    return image("yuv422", [=](int x, int) { return x % 2 == 0 ? Pixel{u, y} : Pixel{v, y}; });
  };
  expectNear(colour(uyvy(126, 128, 128)), {128, 128, 128}, 1);
  expectNear(colour(uyvy(81, 90, 240)), {255, 0, 0}, 2);
  expectNear(colour(uyvy(145, 54, 34)), {0, 255, 0}, 2);
  expectNear(colour(uyvy(41, 240, 110)), {0, 0, 255}, 2);
}

// Each pattern is named after its first row's two colours, then the second's.
TEST(ViewOf, TurnsBayerIntoColour) {
  const Colour expected{200, 120, 40};  // a surface of one colour: interpolation returns it exactly
  for (const std::string pattern : {"rggb", "bggr", "gbrg", "grbg"}) {
    const auto mosaic = image("bayer_" + pattern + "8", [&](int x, int y) {
      const auto channel = std::string("rgb").find(pattern[2 * (y % 2) + x % 2]);
      return Pixel{static_cast<std::uint8_t>(expected[channel])};
    });
    EXPECT_EQ(colour(mosaic), expected) << pattern;
  }
}

TEST(ViewOf, ScalesSixteenBits) {
  expectNear(colour(image("rgb16", all({0, 50, 0, 100, 0, 200}))), {50, 100, 200}, 1);  // little endian
}

TEST(ViewOf, RefusesWhatIsNoPicture) {
  const auto fault = [](const std::string& encoding, const Pixel& pixel) {
    return test::faultOf([&] { viewOf(image(encoding, all(pixel))); });
  };
  EXPECT_TRUE(test::says(fault("32FC1", {0, 0, 0, 0}), "image cannot be read: encoding '32FC1', 8x8"));
  EXPECT_TRUE(test::says(fault("no_such", {0}), "image cannot be read: encoding 'no_such'"));
  EXPECT_TRUE(test::says(fault("", {0}), "image cannot be read: encoding ''"));
}

}  // namespace
}  // namespace field_fusion
