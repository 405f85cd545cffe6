"""Speed against accuracy on one deck, a sweep over its settings: ladder -> points -> distances -> front, advice.

``ladder.py`` has the settings, ``study.py`` runs them, reports and draws, ``trade.py`` compares.
"""
