#include "field_fusion/core/sim/image_encoding.h"

#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

namespace field_fusion::core::sim {
namespace {

/// Pairs of equal pixels, so that halved colours lose nothing.
cv::Mat coloured() {
  cv::Mat rgb(16, 32, CV_8UC3);
  for (int v = 0; v < rgb.rows; ++v)
    for (int u = 0; u < rgb.cols; ++u)
      rgb.at<cv::Vec3b>(v, u) =
          cv::Vec3b(static_cast<unsigned char>(16 * v), static_cast<unsigned char>(8 * (u / 2 * 2)),
                    static_cast<unsigned char>(255 - 16 * v));
  return rgb;
}

TEST(ImageEncoding, Rgb8IsThePictureItself) {
  const cv::Mat rgb = coloured();
  EXPECT_EQ(encoded(rgb, Encoding::kRgb8), std::vector<std::uint8_t>(rgb.datastart, rgb.dataend));
  const auto part = encoded(rgb(cv::Rect(3, 2, 5, 4)), Encoding::kRgb8);  // rows with gaps
  ASSERT_EQ(part.size(), 60u);
  EXPECT_EQ(part[15], rgb.at<cv::Vec3b>(3, 3)[0]);
}

TEST(ImageEncoding, Yuv422IsWhatOpenCvReads) {
  const cv::Mat rgb = coloured();
  std::vector<std::uint8_t> bytes = encoded(rgb, Encoding::kYuv422);
  ASSERT_EQ(bytes.size(), rgb.total() * 2);
  cv::Mat back;
  cv::cvtColor(cv::Mat(rgb.rows, rgb.cols, CV_8UC2, bytes.data()), back, cv::COLOR_YUV2RGB_UYVY);
  EXPECT_LE(cv::norm(rgb, back, cv::NORM_INF), 3.0);
}

TEST(ImageEncoding, JpegIsAFileOfThePicture) {
  const cv::Mat rgb = coloured();
  cv::Mat back = cv::imdecode(encoded(rgb, Encoding::kJpeg, 100), cv::IMREAD_COLOR);
  cv::cvtColor(back, back, cv::COLOR_BGR2RGB);
  ASSERT_EQ(back.size(), rgb.size());
  EXPECT_LT(cv::norm(rgb, back, cv::NORM_L1) / (3.0 * rgb.total()), 6.0);
  EXPECT_LT(encoded(rgb, Encoding::kJpeg, 20).size(), encoded(rgb, Encoding::kJpeg, 95).size());
}

TEST(ImageEncoding, RefusesWhatIsNoPicture) {
  EXPECT_THROW(encoded(cv::Mat(), Encoding::kRgb8), std::invalid_argument);
  EXPECT_THROW(encoded(cv::Mat(4, 4, CV_8UC1), Encoding::kJpeg), std::invalid_argument);
  EXPECT_THROW(encoded(cv::Mat(4, 5, CV_8UC3), Encoding::kYuv422), std::invalid_argument);
}

}  // namespace
}  // namespace field_fusion::core::sim
