# SPDX-FileCopyrightText: 2026 The Sheaf authors
# SPDX-License-Identifier: Apache-2.0

"""Recipes of the committed scenes, one module each, and what they share."""
