// What the detector costs for one frame, its three parts apart. Pre- and post-processing are measured on
// one thread of OpenCV, on made-up data; the network, with each backend on 1 and 2 threads, is the file
// that the argument names, or one in FIELD_FUSION_DATA.
#include <chrono>
#include <cstdlib>
#include <stdexcept>

#include <opencv2/core.hpp>

#include "field_fusion/core/detect/inference.h"
#include "field_fusion/core/detect/letterbox.h"
#include "field_fusion/core/detect/yolo.h"
#include "figure.h"

namespace {

using namespace field_fusion;

const cv::Size kImage(1280, 720), kInput(640, 640);

/// A street's worth of output: 20 bodies, 12 anchors on each, over the faint scores of the rest.
cv::Mat crowdedOutput(int classes, int anchors) {
  const int shape[] = {1, 4 + classes, anchors};
  cv::Mat output(3, shape, CV_32F);
  cv::RNG random(1);
  random.fill(output, cv::RNG::UNIFORM, 0.0, 0.1);
  auto element = [&](int row, int anchor) -> float& { return output.ptr<float>()[row * anchors + anchor]; };
  for (int i = 0; i < 240; ++i) {
    const int anchor = i * 35, body = i / 12;
    const float box[] = {60.f + 130.f * float(body % 5), 180.f + 90.f * float(body / 5), 60.f, 70.f};
    for (int row = 0; row < 4; ++row) element(row, anchor) = box[row] + random.uniform(-3.f, 3.f);
    element(4 + body % classes, anchor) = random.uniform(0.3f, 0.95f);
  }
  return output;
}

void measurePreAndPost(int repeats) {
  cv::setNumThreads(1);
  cv::Mat image(kImage, CV_8UC3);
  cv::RNG(2).fill(image, cv::RNG::UNIFORM, 0, 256);
  core::Letterbox letterbox(kInput);
  const auto pre = bench::costs(repeats, [&] { letterbox.apply(image, core::PixelOrder::kBgr); });
  bench::print("detect/pre_cost", bench::medianFigure(pre), "ms");

  const std::vector<cv::Mat> outputs{crowdedOutput(80, 8400)};
  core::YoloDecoder decoder(core::yoloHead({{1, 84, 8400}}, kInput));
  std::size_t found = 0;
  const auto post = bench::costs(repeats, [&] {
    found = decoder.decode(outputs, letterbox.fit(), core::YoloParams{}).detections.size();
  });
  std::printf("%zu detections from 240 candidates\n", found);
  bench::print("detect/post_cost", bench::medianFigure(post), "ms");
  cv::setNumThreads(-1);
}

/// Wall time: the network's threads are not the caller's.
void measureNetwork(const core::OnnxFile& model, core::Backend backend, const std::string& name, int threads,
                    int repeats) {
  const auto loaded = core::loadNetwork(model, {backend, threads});
  core::Letterbox letterbox(loaded.input_size);
  const cv::Mat& input =
      letterbox.apply(cv::Mat(kImage, CV_8UC3, cv::Scalar(30, 90, 150)), core::PixelOrder::kBgr);
  std::vector<double> costs;
  for (int i = 0; i < repeats; ++i) {
    const auto start = std::chrono::steady_clock::now();
    loaded.network->run(input);
    costs.push_back(
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
  }
  std::printf("%s, %d threads, %dx%d\n", loaded.backend.c_str(), threads, input.size[3], input.size[2]);
  bench::print("detect/" + name + "/cost" + (threads == 1 ? "_1_thread" : ""), bench::medianFigure(costs),
               "ms");
}

}  // namespace

int main(int argc, char** argv) {
  measurePreAndPost(200);
  const char* data = std::getenv("FIELD_FUSION_DATA");
  if (argc < 2 && !data) {
    std::puts("network not measured: no model named, and FIELD_FUSION_DATA is not set");
    return 0;
  }
  const auto model =
      core::readOnnxFile(argc > 1 ? argv[1] : std::string(data) + "/yolov8n_coco/yolov8n_deq_fp32.onnx");
  for (const int threads : {1, 2}) {
    measureNetwork(model, core::Backend::kOpenCv, "opencv", threads, 30);
    try {
      measureNetwork(model, core::Backend::kOpenVino, "openvino", threads, 30);
    } catch (const std::runtime_error& fault) {
      std::printf("OpenVINO not measured: %s\n", fault.what());
    }
  }
}
