"""Pictures of the guide: kept smaller than they are made, and compared."""

from pathlib import Path

from PIL import Image, ImageChops

# Width in pixels that a picture of the guide is made smaller to.
WIDTH = 1000

# Difference of a channel, of 255, that compression may make.
LEVELS = 40


def smaller(path: Path) -> Image.Image:
    """Returns a picture at the size that the guide keeps."""
    image = Image.open(path).convert("RGB")
    image.thumbnail((WIDTH, WIDTH), Image.Resampling.LANCZOS)
    return image


def keep(result: Path, image: Path):
    """Keeps a picture that a run made."""
    image.parent.mkdir(parents=True, exist_ok=True)
    smaller(result).save(image, quality=88, method=6)


def difference(result: Path, image: Path) -> float:
    """Returns the share of the pixels of a kept picture that look different from a run's."""
    made, kept = smaller(result), Image.open(image).convert("RGB")
    if made.size != kept.size:
        return 1.0
    channels = ImageChops.difference(made, kept).split()
    largest = ImageChops.lighter(ImageChops.lighter(channels[0], channels[1]), channels[2])
    counts = largest.histogram()
    return sum(counts[LEVELS + 1 :]) / sum(counts)
