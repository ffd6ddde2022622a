"""How the crossing boat is scored: when messages arrive, where the boat is, what is said of waiting and of stamps."""
import math
from types import SimpleNamespace

import genpy
import numpy
import pytest

import arrivals
import crossing
import usv_latency
import usv_timing
from real_time import percentile, percentile_line
from sim_bag import Body, Frame, Picture
from usv_timing import Case

PARAMETERS = {"class_heights": {}, "class_height_spreads": {}}


def message(seconds):
    return SimpleNamespace(header=SimpleNamespace(stamp=genpy.Time.from_sec(seconds)), detections=[])


def pictures(count=3, period=0.03):
    return [Picture(genpy.Time.from_sec(1000 + i * period), None, None, message(1000 + i * period), None) for i in range(count)]


def stamps(events):
    return [event.message.header.stamp.to_sec() for event in events]


def test_a_late_camera_keeps_its_stamps_and_one_that_stamps_on_arrival_does_not():
    late = list(arrivals.detections(pictures(), arrivals.Camera(0.12), PARAMETERS, 1))
    assert [event.due for event in late] == pytest.approx([1000.12, 1000.15, 1000.18])
    assert stamps(late) == pytest.approx([1000.0, 1000.03, 1000.06])
    shown = pictures()
    stamped = list(arrivals.detections(shown, arrivals.Camera(0.12, stamped_late=True), PARAMETERS, 1))
    assert stamps(stamped) == pytest.approx([event.due for event in stamped])
    assert [picture.detections.header.stamp for picture in shown] == [picture.stamp for picture in shown]  # as before


def test_lost_pictures_are_about_their_share_and_the_same_for_a_seed():
    many = pictures(2000)
    kept = arrivals.kept(many, arrivals.Camera(lost=0.05), 3)
    assert 1900 - 4 * math.sqrt(2000 * 0.05 * 0.95) < len(kept) < 1900 + 4 * math.sqrt(2000 * 0.05 * 0.95)
    assert kept == arrivals.kept(many, arrivals.Camera(lost=0.05), 3)
    assert arrivals.kept(many, arrivals.Camera(), 3) == many and arrivals.kept(many, arrivals.Camera(lost=1.0), 3) == []


def test_a_cloud_arrives_when_its_turn_is_over_and_all_come_in_order():
    frame = SimpleNamespace(stamp=genpy.Time(1000), cloud=message(1000.0))
    events = arrivals.ordered(arrivals.clouds([frame]), arrivals.detections(pictures(), arrivals.Camera(0.05), PARAMETERS, 1))
    assert [event.topic for event in events] == [arrivals.DETECTIONS, arrivals.DETECTIONS, arrivals.CLOUDS, arrivals.DETECTIONS]
    assert events[2].due == pytest.approx(1000.1)


def obstacle(x, y, source, difference=math.nan):
    return SimpleNamespace(position=SimpleNamespace(x=x, y=y), source=source, SOURCE_BOTH=3, azimuth_difference=difference)


def frame(seconds, y, speed, returns=20):
    T = numpy.eye(4)
    T[:3, 3] = [12, y, 0]
    cloud_type = numpy.dtype([("x", "f4"), ("time", "f4")])
    points = numpy.zeros(returns, [("body", "i4")])
    rows = numpy.zeros(returns, cloud_type)
    rows["time"] = 0.05
    fields = [SimpleNamespace(name="x", offset=0), SimpleNamespace(name="time", offset=4)]
    cloud = SimpleNamespace(fields=fields, point_step=8, data=rows.tobytes(), width=returns, height=1)
    return Frame(genpy.Time.from_sec(seconds), cloud, [], None, points, {0: Body("b", "boat", T, numpy.array([6, 2.2, 2]), 1)})


def test_the_boat_counts_at_full_speed_within_the_picture_and_where_the_lidar_sees_it():
    going = [frame(1000 + 0.1 * i, 0.3 * i, 3.0) for i in range(60)]
    moments = crossing.moments(going, 1.0)
    assert moments[0].stamp.to_sec() == pytest.approx(1001.0)
    assert moments[-1].middle[1] <= 12 * math.tan(crossing.ASIDE) < moments[-1].middle[1] + 0.3
    assert moments[0].velocity == pytest.approx([0, 3]) and moments[0].seen_after == pytest.approx(0.05)
    assert moments[0].azimuth_rate() == pytest.approx(3 * 12 / (12 ** 2 + 3 ** 2))  # d atan2(y, x) / dt
    assert crossing.moments([frame(1000 + 0.1 * i, 0.1 * i, 1.0) for i in range(30)], 0.0) == []
    assert crossing.moments([frame(1000 + 0.1 * i, 0.3 * i, 3.0, returns=9) for i in range(30)], 0.0) == []


def moment(stamp=1):
    return crossing.Moment(stamp, numpy.array([12.0, 0.0]), numpy.array([0.0, 3.0]), 0.05)


def test_errors_are_at_the_stamp_and_when_the_beams_met_it():
    words = {1: SimpleNamespace(obstacles=[obstacle(12, 0.15, 3, 0.0125), obstacle(12, 0, 1)]),
             2: SimpleNamespace(obstacles=[obstacle(12.4, 0.15, 1)]),
             3: SimpleNamespace(obstacles=[obstacle(12, 9, 3)])}
    row = usv_timing.scored(Case("free", "on_time", arrivals.Camera()), 1, [moment(1), moment(2), moment(3)], words)
    assert row.matched == [True, False, False]
    assert row.errors == pytest.approx([0.15, math.hypot(0.4, 0.15)]) and row.when_seen == pytest.approx([0, 0.4])
    assert row.behind == pytest.approx([0.05])  # 0.0125 rad at 0.25 rad/s


def test_latency_is_to_the_last_word_and_starts_after_the_first_clouds():
    left = {("/lidar/points", stamp): 10.0 + stamp for stamp in range(4)} | {("/detections", 9): 99.0}
    came = {(usv_timing.OBSTACLES, 1, 0): 11.01, (usv_timing.OBSTACLES, 1, 1): 11.03, (usv_timing.OBSTACLES, 2, 0): 12.02}
    assert usv_timing.latencies(left, came, 1) == pytest.approx([0.03, 0.02])  # cloud 3 got no answer


def stamp(tenths):
    return genpy.Time(1000 + tenths // 10, tenths % 10 * 100000000)


def test_a_fused_latency_starts_with_the_later_of_cloud_and_picture(monkeypatch):
    monkeypatch.setattr(usv_latency, "SETTLED", 0)
    word, shown = usv_latency.OBSTACLES, "/detections"
    left = {("/lidar/points", stamp(i)): i / 10 for i in range(4)} | {("/camera/image_raw", stamp(i)): i / 10 - 0.09 for i in range(4)}
    left["/camera/image_raw", stamp(1)] = 0.12  # after its cloud
    came = {(word, stamp(0), 0): 0.01, (word, stamp(0), 1): 0.03, (shown, stamp(0), 0): 0.035,  # overtaken on its way
            (word, stamp(1), 1): 0.17, (shown, stamp(1), 0): 0.16,
            (word, stamp(2), 1): 0.7, (shown, stamp(2), 0): 0.75,  # went on without
            (word, stamp(3), 0): 0.32, (shown, stamp(3), 0): 0.31}  # no last word
    assert usv_latency.fused(left, came, 0.05) == pytest.approx([0.03, 0.05])
    assert usv_latency.alone(left, came) == pytest.approx([0.01, 0.02])


def test_the_headlines_come_last_and_the_rest_is_named():
    rows = [usv_latency.Row("", "lidar", 1, [0.01], 2), usv_latency.Row("openvino", "10hz_together", 1, [0.05], 2),
            usv_latency.Row("openvino", "10hz_together", 2, [0.07], 2)]
    assert list(usv_latency.lines(rows)) == [
        "figure usv/latency/with_picture/openvino_10hz_together 0.5 - n=4 ci=[0.15,0.85]",
        "figure usv/latency/fused_p99/openvino_10hz_together 70 ms n=2 ci=[50,70]",
        "figure usv/latency/fused_p99 70 ms n=2 ci=[50,70]", "figure usv/latency/lidar_p99 10 ms n=1 ci=[nan,nan]"]


def test_the_histogram_of_the_stage_is_read():
    counts = usv_timing.histogram("below -250: 1, -5..0: 3, 0..5: 12, above 250: 4")
    assert counts == {(-math.inf, -250): 1, (-5, 0): 3, (0, 5): 12, (250, math.inf): 4}
    assert usv_timing.quantile(counts, 0.5) == 2.5 and usv_timing.quantile(counts, 0.15) == -2.5
    assert usv_timing.histogram("") == {} and math.isnan(usv_timing.quantile({}, 0.5))


def test_percentiles():
    assert percentile(range(1, 101), 99) == 99 and percentile(range(1, 101), 50) == 50 and percentile([3], 99) == 3
    assert math.isnan(percentile([], 50))
    assert percentile_line("a", [1.0] * 10, 99, "ms") == "figure a 1 ms n=10 ci=[1,1]"
