# SPDX-FileCopyrightText: 2026 The Sheaf authors
# SPDX-License-Identifier: Apache-2.0
"""python -m sheaf_explore is the explore command."""

from sheaf_explore.cli import main

main()
