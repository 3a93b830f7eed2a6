"""First names, titles, famous persons and cities, in lower case."""

from __future__ import annotations


def _words(text: str) -> frozenset[str]:
    return frozenset(text.split())


MEN = _words(
    """
    james john robert michael william david richard joseph thomas charles christopher daniel
    matthew anthony steven paul andrew joshua kenneth kevin brian george timothy ronald edward
    jason jeffrey ryan jacob gary nicholas eric jonathan stephen larry justin scott brandon
    benjamin samuel gregory alexander patrick frank raymond jerry dennis tyler aaron jose adam
    nathan henry douglas zachary peter kyle noah ethan jeremy walter keith roger terry
    sean gerald carl harold dylan arthur lawrence jesse bryan billy bruce gabriel joe
    logan alan juan albert willie elijah wayne randy vincent roy ralph bobby russell
    philip eugene oliver liam lucas leo oscar hugo ivan igor boris vladimir dmitri ahmed
    mohammed muhammad ali hassan omar ibrahim carlos luis pedro pablo diego miguel antonio
    giovanni marco luca hans klaus fritz jurgen ludwig wolfgang johann kenji hiroshi takeshi
    akira wei barack donald elon abraham napoleon isaac leonardo sherlock harry tony clark steve
    mike tom jim bob dave ben sam dan tim ron fred
    """
)
WOMEN = _words(
    """
    mary patricia jennifer linda elizabeth barbara susan jessica sarah karen lisa nancy betty
    sandra margaret ashley kimberly emily donna michelle amanda melissa deborah stephanie
    rebecca laura helen sharon cynthia kathleen amy shirley angela anna brenda pamela emma
    nicole samantha katherine christine catherine rachel janet maria diane
    julie joyce victoria kelly christina joan evelyn lauren judith olivia martha cheryl megan
    andrea hannah jacqueline ann alice kathryn gloria teresa sara janice julia marie
    theresa judy sophia beverly denise marilyn danielle diana brittany natalie
    isabella charlotte alexis kayla gwen zoe chloe sofia elena olga natasha svetlana tatiana
    fatima aisha leila yuki mei priya ananya lucia carmen isabel francesca giulia heidi
    ingrid astrid freya hermione cleopatra taylor beyonce oprah marie kate jane
    """
)
TITLES: dict[str, str] = {
    **dict.fromkeys(("mr", "sir", "lord", "king", "prince", "uncle", "grandpa"), "man"),
    **dict.fromkeys(("mrs", "ms", "miss", "lady", "queen", "princess", "aunt", "grandma"), "woman"),
    **dict.fromkeys(("dr", "doctor", "professor", "prof", "president", "captain"), "person"),
}
"""Title before a name → who is shown."""
CHARACTERS: dict[str, str] = {
    **dict.fromkeys(
        ("iron man", "spider man", "spiderman", "super man", "superman", "batman",
         "captain america", "darth vader", "luke skywalker", "indiana jones", "james bond",
         "mr bean", "van gogh",
         "vincent van gogh", "da vinci", "leonardo da vinci", "ant man", "aquaman"), "man"),
    **dict.fromkeys(
        ("wonder woman", "cat woman", "catwoman", "mona lisa", "gwen stacy", "lara croft",
         "mary poppins"), "woman"),
}  # fmt: skip
"""Famous persons and figures → who is shown."""
CITIES = _words(
    """
    amsterdam athens atlanta bangkok barcelona beijing berlin bogota boston brussels budapest
    cairo chicago copenhagen dallas delhi dubai dublin edinburgh florence frankfurt geneva hanoi
    havana helsinki houston istanbul jakarta jerusalem kyoto lisbon london madrid manhattan
    marrakech melbourne miami milan montreal moscow mumbai munich nairobi naples osaka oslo
    paris philadelphia prague rome santiago seattle seoul shanghai singapore stockholm sydney
    taipei tokyo toronto vancouver venice vienna warsaw washington zurich brooklyn hollywood
    """
) | {
    "hong kong", "las vegas", "los angeles", "mexico city", "new delhi", "new york",
    "new york city", "rio de janeiro", "san francisco", "sao paulo", "buenos aires",
    "cape town", "kuala lumpur", "the bund", "times square",
}  # fmt: skip
"""Cities: each is shown as a city."""
