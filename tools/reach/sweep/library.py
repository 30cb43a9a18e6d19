"""Dask's `distributed` with the settings that sweeps want; import it from here, so that they hold
before the library reads them. What a user has set for TLS stays."""

import dask

dask.config.set(
    {
        # A run's failure is told by the sweep, in words of ours.
        "logging": {"distributed": "critical", "distributed.client": "critical"},
        "distributed.comm.timeouts.connect": "60s",  # a busy machine answers late
        # No pages about the cluster, on any port.
        "distributed.scheduler.http.routes": [],
        "distributed.worker.http.routes": [],
        # What a worker does is wait for another process.
        "distributed.worker.profile.enabled": False,
        "distributed.admin.system-monitor.gil.enabled": False,
    }
)

import distributed  # noqa: E402 - after its settings

__all__ = ["HTTP", "distributed"]

# Where schedulers and workers listen for browsers, as they must, and have nothing to show.
HTTP = "127.0.0.1:0"
