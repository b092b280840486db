# SPDX-FileCopyrightText: 2026 The Sheaf authors
# SPDX-License-Identifier: Apache-2.0
"""The experiments of "Deep Coherent Ray Tracing" (Månsson et al. 2007), made again and compared."""
