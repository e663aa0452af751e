// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/transport/light_transport.h"

#include "solver/transport/gathering.h"
#include "solver/transport/shooting.h"

namespace sunload {

std::unique_ptr<const LightTransport> transport_of(const TracedScene& traced) {
  if (traced.rules.transport == Transport::shoot) return std::make_unique<Shooting>(traced);
  return std::make_unique<Gathering>(traced);
}

}  // namespace sunload
