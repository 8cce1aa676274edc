// SPDX-License-Identifier: MIT
#include "apps/commands/commands.h"

#include "apps/commands/calibrate.h"
#include "apps/commands/completion.h"
#include "apps/commands/config.h"
#include "apps/commands/eval.h"
#include "apps/commands/export.h"
#include "apps/commands/features.h"
#include "apps/commands/learn.h"
#include "apps/commands/match.h"
#include "apps/commands/run.h"
#include "apps/commands/synth.h"

namespace corvo {

void AddCommands(CLI::App& app, int& exit_code) {
  AddRunCommand(app, exit_code);
  AddCalibrateCommand(app, exit_code);
  AddEvalCommand(app);
  AddExportCommand(app);
  AddSynthCommand(app, exit_code);
  AddFeaturesCommand(app);
  AddMatchCommand(app);
  AddLearnCommand(app);
  AddConfigCommand(app);
  AddCompletionCommands(app);
}

std::vector<const CLI::App*> CommandsOf(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App*) { return true; });
}

}  // namespace corvo
