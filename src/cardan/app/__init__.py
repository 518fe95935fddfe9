"""The app: a drive turning in the browser, and every question about it beside it.

Nothing is computed here. `state` holds what one user works on, without a browser; `parts` shows it; `scene` is the view
in space.
"""
