#!/usr/bin/python3
"""Draws what a simulation truly shows into its camera's picture, and says so in it: /annotated_image."""
import cv2
import numpy
import rospy
from field_fusion.msg import ImageDetectionArray
from sensor_msgs.msg import Image

CAPTION = "simulated; boxes are the simulator's truth, not a detector's"
GREEN, WHITE = (80, 240, 100), (255, 255, 255)
FONT = cv2.FONT_HERSHEY_SIMPLEX


def drawn(pixels, detections):
    pixels = pixels.copy()
    for d in detections:
        corner = (round(d.x_min), round(d.y_min))
        cv2.rectangle(pixels, corner, (round(d.x_max), round(d.y_max)), GREEN, 1)
        cv2.putText(pixels, f"{d.label} {d.score:.1f}", (corner[0], max(10, corner[1] - 3)), FONT, 0.4, GREEN, 1, cv2.LINE_AA)
    cv2.putText(pixels, CAPTION, (8, pixels.shape[0] - 8), FONT, 0.5, WHITE, 1, cv2.LINE_AA)
    return pixels


class Drawer:
    def __init__(self):
        self.image = None
        self.publisher = rospy.Publisher("/annotated_image", Image, queue_size=2)
        self.subscribers = [rospy.Subscriber("/camera/image_raw", Image, self._on_image, queue_size=2),
                            rospy.Subscriber("/truth/camera/detections", ImageDetectionArray, self._on_detections, queue_size=2)]

    def _on_image(self, image):
        self.image = image

    def _on_detections(self, message):
        image = self.image  # the bag has it just before
        if image is None or image.header.stamp != message.header.stamp:
            return
        pixels = numpy.frombuffer(image.data, numpy.uint8).reshape(image.height, image.width, 3)
        self.publisher.publish(Image(header=image.header, height=image.height, width=image.width, encoding=image.encoding,
                                     step=image.step, data=drawn(pixels, message.detections).tobytes()))


if __name__ == "__main__":
    rospy.init_node("truth_image", disable_signals=False)
    drawer = Drawer()
    rospy.spin()
