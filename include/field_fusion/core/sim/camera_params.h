#pragma once
// How good a colour camera is. Numbers of real ones, with their sources, are in config/sensors/.
#include "field_fusion/core/base/params.h"

namespace field_fusion::core::sim {

enum class Encoding { kRgb8, kYuv422, kJpeg };

/// The lens is ROS's plumb_bob: pixel (0, 0) is the middle of the first pixel.
struct CameraParams {
  double rate = 30.0;
  int width = 640, height = 480;
  double fx = 554.3, fy = 554.3, cx = 319.5, cy = 239.5;
  double k1 = 0.0, k2 = 0.0, p1 = 0.0, p2 = 0.0, k3 = 0.0;
  int samples = 1;
  bool auto_exposure = true;
  double brightness = 0.2, exposure_delay = 0.3;
  double exposure_time = 1.0, max_exposure_time = 20.0, white_time = 2.0;
  double gain = 0.0, max_gain = 24.0;
  bool noise = true;
  double full_well = 10500.0, read_noise = 2.4;
  double vignetting = 0.2, glare = 0.1;
  bool reflections = true;
  Encoding encoding = Encoding::kRgb8;
  int jpeg_quality = 90;
  int threads = 1;

  void declare(Params& p) {
    declareLens(p);
    declareExposure(p);
    declareFaults(p);
    p.number("rate", rate, {0.1, 1000.0}, "Hz", When::kStart, "Pictures a second.");
    p.number("samples", samples, {1, 4}, "", When::kStart, "Rays along each side of a pixel.");
    p.flag("reflections", reflections, When::kStart, "Water mirrors bodies too, not the sky alone.");
    p.choice("encoding", encoding, {"rgb8", "yuv422", "jpeg"}, When::kStart, "Of the picture sent.");
    p.number("jpeg_quality", jpeg_quality, {1, 100}, "", When::kStart, "For the encoding jpeg.");
    p.number("threads", threads, {0, 64}, "", When::kStart, "That share a picture; 0: as many as cores.");
  }

 private:
  void declareLens(Params& p) {
    p.number("width", width, {16, 8192}, "px", When::kStart, "Of the picture.");
    p.number("height", height, {16, 8192}, "px", When::kStart, "Of the picture.");
    p.number("fx", fx, {1.0, 1e5}, "px", When::kStart, "Focal length along the rows.");
    p.number("fy", fy, {1.0, 1e5}, "px", When::kStart, "Focal length along the columns.");
    p.number("cx", cx, {-1e4, 1e4}, "px", When::kStart, "Column of the optical axis.");
    p.number("cy", cy, {-1e4, 1e4}, "px", When::kStart, "Row of the optical axis.");
    p.number("k1", k1, {-10.0, 10.0}, "", When::kStart, "Radial distortion, second power of the radius.");
    p.number("k2", k2, {-10.0, 10.0}, "", When::kStart, "Radial distortion, fourth power.");
    p.number("p1", p1, {-1.0, 1.0}, "", When::kStart, "Tangential distortion, along the columns.");
    p.number("p2", p2, {-1.0, 1.0}, "", When::kStart, "Tangential distortion, along the rows.");
    p.number("k3", k3, {-10.0, 10.0}, "", When::kStart, "Radial distortion, sixth power.");
  }
  void declareExposure(Params& p) {
    p.flag("auto_exposure", auto_exposure, When::kStart, "Or exposure_time and gain as they are.");
    p.number("brightness", brightness, {0.01, 0.9}, "", When::kStart,
             "Mean of a picture that auto_exposure aims at, in linear light, 1 is white.");
    p.number("exposure_delay", exposure_delay, {0.0, 60.0}, "s", When::kStart,
             "Time constant of auto_exposure; 0: right in the next picture.");
    p.number("exposure_time", exposure_time, {1e-3, 1000.0}, "ms", When::kStart, "Without auto_exposure.");
    p.number("max_exposure_time", max_exposure_time, {1e-3, 1000.0}, "ms", When::kStart,
             "Longest of auto_exposure; more light than that comes from gain.");
    p.number(
        "white_time", white_time, {1e-3, 1000.0}, "ms", When::kStart,
        "Exposure in which a white sheet that faces a sun of brightness 1 fills the pixels: the aperture.");
    p.number("gain", gain, {0.0, 60.0}, "dB", When::kStart, "Without auto_exposure.");
    p.number("max_gain", max_gain, {0.0, 60.0}, "dB", When::kStart, "Highest of auto_exposure.");
    p.rule([this] { return max_exposure_time <= 1e3 / rate; },
           "max_exposure_time must fit between two pictures");
    p.rule([this] { return exposure_time <= 1e3 / rate; }, "exposure_time must fit between two pictures");
  }
  void declareFaults(Params& p) {
    p.flag("noise", noise, When::kStart, "Shot and read noise.");
    p.number("full_well", full_well, {10.0, 1e6}, "e-", When::kStart, "Electrons of a white pixel at 0 dB.");
    p.number("read_noise", read_noise, {0.0, 1000.0}, "e-", When::kStart, "Sigma of a dark pixel.");
    p.number("vignetting", vignetting, {0.0, 1.0}, "", When::kStart, "Share of light that corners lose.");
    p.number("glare", glare, {0.0, 10.0}, "", When::kStart,
             "Light that the lens scatters about the sun, 1 is as much as a human eye; 0: none.");
  }
};

}  // namespace field_fusion::core::sim
