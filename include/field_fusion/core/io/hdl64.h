#pragma once
// What a KITTI cloud does not store of each point: the row of the sensor and the time within the turn.
#include <cstdint>

namespace field_fusion::core {

/// Row of the nearest nominal beam, 0 is the lowest, for an elevation [rad] seen from the sensor's origin.
/// Velodyne HDL-64E: 32 beams from -24.33 deg every 1/2 deg, then 32 from -8.33 to +2 deg every 1/3 deg;
/// what lies outside belongs to the lowest or highest. kUnknownRing for NaN.
///
/// A nominal row, not the laser's number: lasers are calibrated one by one and leave the head at different
/// heights. In KITTI's clouds the lasers lie up to 0.6 deg (two rows) above nominal in the upper block and
/// up to 2 deg (four rows) above it at the bottom.
std::uint16_t hdl64Ring(double elevation);

/// [s] after the stamp at which a scanner looks along `azimuth` [rad], in [-turn / 2, turn / 2].
/// KITTI's raw data development kit: the scanner turns counter-clockwise at 10 Hz, and the cameras, whose
/// stamp the frame bears, are triggered when it looks straight ahead. NaN for NaN.
///
/// An even turn is assumed (KITTI's real turns last 0.1 s +- some ms), and no parallax of the lasers; the
/// two sides of the seam behind the vehicle are a turn apart.
float turnTime(double azimuth, double turn = 0.1);

}  // namespace field_fusion::core
