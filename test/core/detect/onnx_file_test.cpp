#include "field_fusion/core/detect/onnx_file.h"

#include <random>

#include "support/detect_fixtures.h"

namespace field_fusion::core {
namespace {

const std::string kImage =
    detectDimension(1) + detectDimension(3) + detectDimension(48) + detectDimension(64);

TEST(OnnxFile, TellsInputAndMetadata) {
  const OnnxFile file = parseOnnx(detectOnnx(kImage) + detectMetadata("task", "detect"), "m");
  EXPECT_EQ(file.input_shape, (std::vector<int>{1, 3, 48, 64}));
  EXPECT_EQ(file.metadata.at("task"), "detect");
  EXPECT_EQ(imageInputSize(file), cv::Size(64, 48));
}

TEST(OnnxFile, ReadsWhatTheOnnxPackageWrote) {
  const OnnxFile file = readOnnxFile(detectFixture("stock_head.onnx"));
  EXPECT_EQ(file.input_shape, (std::vector<int>{1, 3, 32, 32}));
  EXPECT_EQ(file.metadata.at("names"), "{0: 'red', 1: 'green'}");
}

TEST(OnnxFile, TakesOnlyTheFirstInputOfAGraph) {
  const auto input = [](const std::string& dimensions) {
    return detectBytes(11, detectBytes(2, detectBytes(1, detectNumber(1, 1) + detectBytes(2, dimensions))));
  };
  const std::string graph = detectBytes(7, input(kImage) + input(detectDimension(9)));
  EXPECT_EQ(parseOnnx(detectNumber(1, 7) + graph + detectBytes(8, "\x10\x0c"), "m").input_shape.size(), 4u);
}

TEST(OnnxFile, NamesTheFaultOfAFileThatCannotBeRead) {
  EXPECT_EQ(test::faultOf([] { readOnnxFile("/nowhere/m.onnx"); }), "model '/nowhere/m.onnx': no such file");
  EXPECT_EQ(test::faultOf([] { readOnnxFile("/tmp"); }), "model '/tmp': cannot be read");
  EXPECT_EQ(test::faultOf([] { parseOnnx("", "m"); }), "model 'm': the file is empty");
  EXPECT_TRUE(
      test::says(test::faultOf([] { parseOnnx("<!DOCTYPE html><title>404</title>", "m"); }), "not ONNX"));
}

TEST(OnnxFile, RefusesEveryTruncation) {
  const std::string whole = detectFileBytes(detectFixture("unnamed_classes.onnx"));
  ASSERT_NO_THROW(parseOnnx(whole, "m"));
  for (std::size_t size = 0; size < whole.size(); ++size)
    EXPECT_THROW(parseOnnx(whole.substr(0, size), "m"), std::runtime_error) << size << " bytes";
}

TEST(OnnxFile, RefusesLengthsBeyondTheFile) {
  for (const std::uint64_t length :
       {std::uint64_t{100}, std::uint64_t{1} << 31, std::uint64_t{1} << 32, ~std::uint64_t{0}}) {
    const std::string bytes = detectVarint(7 << 3 | 2) + detectVarint(length) + "graph";
    EXPECT_TRUE(test::says(test::faultOf([&] { parseOnnx(bytes, "m"); }), "middle of a field")) << length;
  }
}

TEST(OnnxFile, RefusesWhatProtobufForbids) {
  EXPECT_TRUE(
      test::says(test::faultOf([] { parseOnnx(std::string(11, '\xff'), "m"); }), "more than 64 bits"));
  EXPECT_TRUE(test::says(test::faultOf([] { parseOnnx(std::string(1, '\x0b'), "m"); }), "unknown wire type"));
  EXPECT_TRUE(test::says(test::faultOf([] { parseOnnx(std::string(2, '\0'), "m"); }), "number 0"));
}

TEST(OnnxFile, SurvivesAnyChangedByte) {
  const std::string whole = detectFileBytes(detectFixture("stock_head.onnx"));
  std::mt19937 random(7);
  int refused = 0;
  for (int i = 0; i < 5000; ++i) {
    std::string bytes = whole;
    for (int k = 0; k < 3; ++k) bytes[random() % bytes.size()] = static_cast<char>(random());
    try {
      parseOnnx(bytes, "m");
    } catch (const std::runtime_error&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 0);
}

TEST(ImageInputSize, RefusesOtherInputsWithTheirShape) {
  const auto fault = [](const std::string& bytes) {
    return test::faultOf([&] { imageInputSize(parseOnnx(bytes, "m")); });
  };
  EXPECT_TRUE(test::says(fault(detectOnnx(kImage, 10)), "not float32, 1x3x48x64"));
  EXPECT_TRUE(test::says(fault(detectOnnx(detectDimension(1) + detectDimension(90))), "1x90"));
  const std::string open = detectBytes(1, detectBytes(2, "height"));
  EXPECT_TRUE(
      test::says(fault(detectOnnx(detectDimension(1) + detectDimension(3) + open + open)), "1x3x?x?"));
  const std::string huge =
      detectDimension(1) + detectDimension(3) + detectDimension(1 << 20) + detectDimension(1 << 20);
  EXPECT_TRUE(test::says(fault(detectOnnx(huge)), "1x3x1048576x1048576"));
  EXPECT_TRUE(test::says(fault(detectOnnx(detectDimension(~std::uint64_t{0}))), "out of range"));
}

}  // namespace
}  // namespace field_fusion::core
