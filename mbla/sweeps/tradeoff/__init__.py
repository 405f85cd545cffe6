"""Speed against accuracy on one deck, a sweep over its settings: settings -> points -> distances -> front, advice.

``settings.py`` has the settings, ``study.py`` runs them, reports and draws, ``trade.py`` compares.
"""
