"""What the command lines share."""
import argparse


def input_size(text):
    """(width, height) from "640" or "640x480"."""
    try:
        sides = [int(side) for side in text.split("x")]
    except ValueError:
        sides = []
    size = tuple(sides * 2 if len(sides) == 1 else sides)
    if len(size) != 2 or any(side <= 0 or side % 32 for side in size):
        raise argparse.ArgumentTypeError(f"'{text}' is not one or two multiples of 32, as 640 or 640x480")
    return size


def number(kind, low, high=float("inf"), above=False):
    """An argument's type: a whole number (int) or any (float) from `low`, or `above` it, to `high`."""
    def read(text):
        value = kind(text)  # argparse tells of a ValueError
        if not (low < value if above else low <= value) or not value <= high or value == float("inf"):
            raise argparse.ArgumentTypeError(f"{text} is not {'above' if above else 'from'} {low:g}{'' if high == float('inf') else f' to {high:g}'}")
        return value
    read.__name__ = kind.__name__
    return read
