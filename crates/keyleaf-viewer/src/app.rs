//! The event loop: window events in, frames out, and rest while nothing changes.

use crate::action::{self, Action};
use crate::opening::Opened;
use crate::perform::Ask;
use crate::picking::Picker;
use crate::reload::{Changed, Watch};
use crate::remembered::Remembered;
use crate::script::{Input, Script};
use crate::shell::Shell;
use crate::viewer::Viewer;
use crate::{Options, library, panels};
use anyhow::Context;
use egui::ViewportId;
use egui_winit::winit;
use keyleaf_stage::Pipelines;
use std::path::PathBuf;
use std::time::{Duration, Instant};
use winit::application::ApplicationHandler;
use winit::event::{StartCause, WindowEvent};
use winit::event_loop::{ActiveEventLoop, ControlFlow, EventLoop, EventLoopProxy};
use winit::window::WindowId;

/// What wakes the loop from other threads.
pub enum Wake {
    /// A file was opened, or not.
    Opened(Box<Opened>),
    /// A file that is watched has changed.
    Changed(Changed),
}

/// Runs the loop until the window is closed.
///
/// # Errors
/// See [`crate::run`].
pub fn run(options: Options) -> anyhow::Result<()> {
    let script = match (&options.script, &options.screenshot) {
        (Some(file), _) => Some(Script::read(file)?),
        (None, Some(picture)) => Some(Script::of_screenshot(picture, options.frames)),
        (None, None) => None,
    };
    let events = EventLoop::<Wake>::with_user_event()
        .build()
        .context("there is no display to open a window on")?;
    let mut app = App::new(options, script, events.create_proxy());
    events.run_app(&mut app).context("the window system failed")?;
    app.outcome
}

/// The viewer with its window.
pub struct App {
    pub(crate) options: Options,
    pub(crate) viewer: Viewer,
    pub(crate) shell: Option<Shell>,
    pub(crate) pipelines: Pipelines,
    pub(crate) picker: Picker,
    pub(crate) context: egui::Context,
    pub(crate) watch: Option<Watch>,
    pub(crate) proxy: EventLoopProxy<Wake>,
    /// The request whose answer counts.
    pub(crate) request: u64,
    /// Frames that showed a scene.
    pub(crate) frames: u64,
    /// From the start of the program to the first frame with a scene.
    pub(crate) first_frame: Option<Duration>,
    /// What the device refused, all of it.
    pub(crate) refused: Vec<String>,
    script: Option<Script>,
    changed: Option<(Changed, Instant)>,
    pub(crate) remembered: Remembered,
    is_hidden: bool,
    last_frame: Instant,
    outcome: anyhow::Result<()>,
}

/// The time that a frame takes in a script, in seconds: what it does must not depend on the machine.
const SCRIPT_STEP: f64 = 1.0 / 30.0;
/// Editors write in several steps: changes are taken up after this.
const CHANGE_DELAY: Duration = Duration::from_millis(150);

impl App {
    fn new(options: Options, script: Option<Script>, proxy: EventLoopProxy<Wake>) -> Self {
        // What a script shows must not depend on who was here before.
        let remembered = if script.is_some() {
            Remembered::default()
        } else {
            Remembered::load()
        };
        let near = options.file.as_deref();
        let library = library::scenes(near.and_then(|file| file.canonicalize().ok()).as_deref());
        Self {
            viewer: Viewer::new(remembered.shown.clone(), library),
            shell: None,
            pipelines: Pipelines::default(),
            picker: Picker::default(),
            context: egui::Context::default(),
            watch: None,
            proxy,
            request: 0,
            frames: 0,
            first_frame: None,
            refused: Vec::new(),
            script,
            changed: None,
            remembered,
            is_hidden: false,
            last_frame: Instant::now(),
            outcome: Ok(()),
            options,
        }
    }

    /// Whether steps drive the viewer.
    pub(crate) fn is_scripted(&self) -> bool {
        self.script.is_some()
    }

    /// The theme that was chosen.
    pub(crate) fn set_theme(&self) {
        let light = self.viewer.shown.light;
        self.context
            .set_theme(if light { egui::Theme::Light } else { egui::Theme::Dark });
    }

    /// One frame.
    fn redraw(&mut self, events: &ActiveEventLoop) {
        if self.shell.as_ref().is_some_and(|shell| shell.gpu.is_lost()) {
            self.rebuild();
        }
        let is_scripted = self.is_scripted();
        if self.is_hidden && !is_scripted {
            return;
        }
        let now = Instant::now();
        let elapsed = now
            .duration_since(std::mem::replace(&mut self.last_frame, now))
            .as_secs_f64();
        // After a rest nothing jumps.
        let seconds = if is_scripted { SCRIPT_STEP } else { elapsed.min(0.1) };
        self.viewer.advance(seconds);
        let Some(shell) = &mut self.shell else { return };
        let mut raw = shell.interface.take_egui_input(&shell.window);
        if is_scripted {
            raw.time = Some(self.viewer.time);
            raw.focused = true;
        }
        let dropped: Vec<PathBuf> = raw.dropped_files.iter().map(|file| file.path().to_path_buf()).collect();
        self.viewer.actions.extend(dropped.into_iter().map(Action::Open));
        let context = self.context.clone();
        let mut output = context.run_ui(raw, |ui| {
            self.viewer.actions.extend(action::pressed(ui.ctx()));
            panels::show(&mut self.viewer, ui, seconds);
        });
        let delay = output
            .viewport_output
            .get(&ViewportId::ROOT)
            .map_or(Duration::MAX, |o| o.repaint_delay);
        let platform = std::mem::take(&mut output.platform_output);
        shell.interface.handle_platform_output(&shell.window, platform);
        let asked = self.perform();
        let time = self.viewer.timeline.time;
        let posed = self.viewer.document.as_mut().map_or(Ok(()), |d| d.set_time(time));
        if let Err(error) = posed {
            self.viewer.complain(format!("{error:#}"));
        }
        self.draw(output);
        self.answer(asked, events);
        self.schedule(events, delay);
    }

    fn draw(&mut self, mut output: egui::FullOutput) {
        let Some(shell) = &mut self.shell else {
            output.textures_delta.clear();
            return;
        };
        let has_scene = self.viewer.document.is_some();
        let drawn = shell.painter.draw(
            &mut shell.gpu,
            &mut self.viewer,
            &mut self.pipelines,
            &self.context,
            output,
        );
        match drawn {
            Ok(true) if has_scene => {
                self.frames += 1;
                let started = self.options.started;
                self.first_frame.get_or_insert_with(|| started.elapsed());
            }
            Ok(_) => {}
            Err(error) => self.viewer.complain(format!("{error:#}")),
        }
        let refused = shell.gpu.take_errors();
        if let Some(first) = refused.first() {
            eprintln!("error: the device refused: {first}");
            self.viewer.complain(format!("the device refused: {first}"));
        }
        self.refused.extend(refused);
        if let Some(document) = &self.viewer.document
            && document.is_settled()
            && document.frozen.is_none()
            && let Some(statistics) = document.statistics()
        {
            let view = self.viewer.view();
            self.viewer
                .levels
                .count(&shell.gpu.headless, &document.stage, &statistics, &view);
        }
    }

    /// When the next frame is due.
    fn schedule(&mut self, events: &ActiveEventLoop, delay: Duration) {
        let Some(shell) = &self.shell else { return };
        let is_due = self.viewer.is_busy() || self.is_scripted() || delay.is_zero();
        if is_due {
            shell.window.request_redraw();
            events.set_control_flow(ControlFlow::Wait);
            return;
        }
        let said = self.viewer.message.as_ref().map(|m| m.until - self.viewer.time);
        let said = said
            .filter(|s| s.is_finite())
            .map(|s| Duration::from_secs_f64(s.max(0.0)));
        let changed = self.changed.map(|(_, at)| at.saturating_duration_since(Instant::now()));
        let next = [Some(delay), said, changed]
            .into_iter()
            .flatten()
            .min()
            .unwrap_or(Duration::MAX);
        events.set_control_flow(match Instant::now().checked_add(next) {
            Some(at) => ControlFlow::WaitUntil(at),
            None => ControlFlow::Wait,
        });
    }

    /// Ends with an error.
    pub(crate) fn fail(&mut self, error: anyhow::Error) {
        if self.outcome.is_ok() {
            self.outcome = Err(error);
        }
        self.viewer.actions.push(Action::Quit);
    }

    /// The next step of the script, fed in as events of the window are.
    fn step(&mut self, events: &ActiveEventLoop) {
        let Some(mut script) = self.script.take() else { return };
        let inputs = script.next(&self.viewer, self.shell.as_ref().map(|s| &*s.window));
        self.script = Some(script);
        for input in inputs {
            match input {
                Input::Event(event) => {
                    if let Some(id) = self.shell.as_ref().map(|s| s.window.id()) {
                        self.window_event(events, id, event);
                    }
                }
                Input::Interface(event) => {
                    if let Some(shell) = &mut self.shell {
                        shell.interface.egui_input_mut().events.push(event);
                    }
                }
                Input::Ask(ask) => {
                    if let Err(error) = self.ask(ask) {
                        self.fail(error);
                    }
                }
                Input::Fail(text) => self.fail(anyhow::Error::msg(text)),
                Input::Quit => {
                    if !self.refused.is_empty() {
                        let all = self.refused.join("\n");
                        self.fail(anyhow::anyhow!("the device refused:\n{all}"));
                    }
                    self.viewer.actions.push(Action::Quit);
                }
            }
        }
    }

    /// Does what is left of the actions of a frame, now that it is drawn.
    fn answer(&mut self, asked: Vec<Ask>, events: &ActiveEventLoop) {
        for ask in asked {
            if ask == Ask::Quit {
                self.remember();
                events.exit();
            } else if let Err(error) = self.ask(ask) {
                self.viewer.complain(format!("{error:#}"));
            }
        }
    }
}

impl ApplicationHandler<Wake> for App {
    fn new_events(&mut self, _: &ActiveEventLoop, cause: StartCause) {
        if let (StartCause::ResumeTimeReached { .. }, Some(shell)) = (cause, &self.shell) {
            shell.window.request_redraw();
        }
    }

    fn resumed(&mut self, events: &ActiveEventLoop) {
        if self.shell.is_none()
            && let Err(error) = self.start(events)
        {
            self.outcome = Err(error);
            events.exit();
        }
    }

    fn user_event(&mut self, _: &ActiveEventLoop, wake: Wake) {
        match wake {
            Wake::Opened(opened) => self.opened(*opened),
            Wake::Changed(changed) => self.changed = Some((changed, Instant::now() + CHANGE_DELAY)),
        }
        if let Some(shell) = &self.shell {
            shell.window.request_redraw();
        }
    }

    fn window_event(&mut self, events: &ActiveEventLoop, _: WindowId, event: WindowEvent) {
        let Some(shell) = &mut self.shell else { return };
        let is_redraw = event == WindowEvent::RedrawRequested;
        if shell.interface.on_window_event(&shell.window, &event).repaint && !is_redraw {
            shell.window.request_redraw();
        }
        match event {
            WindowEvent::CloseRequested => {
                self.remember();
                events.exit();
            }
            WindowEvent::Resized(size) => {
                shell.gpu.resize(size.width, size.height);
                self.is_hidden = size.width == 0 || size.height == 0;
                shell.window.request_redraw();
            }
            WindowEvent::Occluded(is_hidden) => {
                self.is_hidden = is_hidden;
                shell.window.request_redraw();
            }
            WindowEvent::RedrawRequested => {
                if self.changed.is_some_and(|(_, at)| at <= Instant::now())
                    && let Some((changed, _)) = self.changed.take()
                {
                    self.take_up(changed);
                }
                self.step(events);
                self.redraw(events);
            }
            _ => {}
        }
    }
}
