"""Words of mood and manner: they change nothing that is drawn, and a note names them."""

from __future__ import annotations


def _words(text: str) -> frozenset[str]:
    return frozenset(text.split())


MOODS = _words(
    """
    cute happy tranquil serene peaceful cozy cosy lovely gorgeous stunning breathtaking majestic
    epic dramatic mysterious romantic joyful cheerful adorable charming elegant graceful
    magnificent spectacular amazing wonderful quaint inviting nostalgic whimsical eerie spooky
    ominous thoughtful curious proud brave friendly picturesque scenic iconic timeless surreal
    dreamy ethereal mystical enchanting magical imposing glamorous chic luxurious exquisite
    playful contented relaxed excited sad angry lonesome melancholic pensive solemn festive
    lively idyllic awesome incredible fantastic fabulous attractive handsome sweet funny silly
    goofy clever mischievous determined confident captivating mesmerizing mesmerising evocative
    inspiring atmospheric immersive ordinary typical usual everyday adult
    """
)
"""Adjectives."""
MANNERS = _words(
    """
    happily gracefully peacefully patiently confidently proudly joyfully playfully cheerfully
    lovingly tenderly excitedly curiously majestically serenely beautifully elegantly
    effortlessly contentedly thoughtfully eagerly gleefully intently diligently skillfully
    skilfully expertly smoothly merrily blissfully comfortably deliciously
    """
)
"""Adverbs."""
