"""nature: an independent generator of synthetic single-wheel campaigns.

It shares no code, no form and no constant with soilbin itself: only the sign conventions, the base model's definition
(Wong and Reece 1967) and the campaign format are common. `python3 -m nature --help` says how to run it, from bench/loop.

    wheel.py        the base model, with joints where an effect may act
    families/       the effects: for each id of the catalogue at least two equations, and some outside it
    design.py       wheels, soils, priors and the plan of the runs
    noise.py        the noise of the channels: covariance, draws, whitening, outliers
    sensitivity.py  what refitting the soil absorbs; noncentrality; the size of an effect
    campaign.py     one campaign: drawing, writing, making more runs
    sets.py         which campaigns a set holds, and its truth.json
    selftest.py     the checks
"""
