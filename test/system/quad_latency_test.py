"""Which messages count as late or lost, by rule."""
import pytest

import quad_latency


def test_a_latency_is_that_of_the_image_with_the_maps_stamp():
    images = {1.0: 10.0, 1.1: 10.1, 1.2: 10.2}
    assert quad_latency.latencies(images, {1.0: 10.03, 1.2: 10.25, 1.15: 10.3}) == pytest.approx([0.03, 0.05])
    assert quad_latency.latencies(images, {}) == quad_latency.latencies({}, {1.0: 2.0}) == []


def test_lost_is_what_was_lost_since_the_stages_had_settled():
    told = [(1.0, "voxel_map", {"image: dropped": "3", "image: missing": "0", "image: received": "5"}),
            (2.0, "voxel_map", {"image: dropped": "4", "image: missing": "0", "image: received": "9"}),
            (3.0, "voxel_map", {"image: dropped": "4", "image: missing": "2", "image: received": "30"}),
            (3.0, "grid_slam", {"scan: dropped": "0"})]
    assert quad_latency.lost(told, 2.5) == {"voxel_map, image: missing": 2}
    assert quad_latency.lost(told, 1.5) == {"voxel_map, image: dropped": 1, "voxel_map, image: missing": 2}
    assert quad_latency.lost(told, 0.5) == {"voxel_map, image: dropped": 4, "voxel_map, image: missing": 2}, "told only afterwards"
    assert quad_latency.lost([], 1.0) == {}
